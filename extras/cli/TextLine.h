// Plays a text line by line: a recording, JSON lines, a table of frames. However long the text is, only a few lines are
// in memory.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "line/Line.h"
#include "line/ports/PipeAges.h"
#include "line/capture/PackedFile.h"
#include "line/file/LineReader.h"
#include "line/file/LineSplitter.h"

namespace tool {

// The source of a text: a file or a pipe.
class TextInput {
 public:
  virtual ~TextInput() = default;

  // Waits for at most `ms`. Returns true if read() would not wait.
  virtual bool isReady(int ms) = 0;

  // Waits for at least one character. Returns those received; nothing at the end.
  virtual std::string_view read() = 0;

  // Returns why the text could not be read to its end; otherwise empty.
  virtual std::string failure() const = 0;
};

// A file, packed or not.
class FileText : public TextInput {
 public:
  // `isRaw`: its bytes are no text. Throws std::runtime_error if it cannot be opened.
  FileText(const std::string &path, const std::string &name, bool isRaw = false);

  bool isReady(int /*ms*/) override { return true; }
  std::string_view read() override { return _isRaw ? _file.read() : _text.read(); }
  std::string failure() const override { return _file.failure(); }

 private:
  line::PackedFile _file;
  line::TextFile _text;
  const bool _isRaw;
};

// A pipe, which the caller closes. `begin` has already been read from it.
class PipeText : public TextInput {
 public:
  PipeText(int file, std::string begin) : _file(file), _begin(std::move(begin)) {}

  bool isReady(int ms) override;
  std::string_view read() override;
  std::string failure() const override { return _failure; }

 private:
  const int _file;
  std::string _begin;
  std::string _read;
  line::PlainText _plain;
  bool _ended = false;
  std::string _failure;
};

// Splits a source's text into lines.
class TextLines : public line::LineSplitter {
 public:
  explicit TextLines(std::unique_ptr<TextInput> input) : _input(std::move(input)) {}

  bool isReady(int ms) { return _input->isReady(ms); }

  // Waits for at least one character.
  void read() { put(_input->read()); }

  std::string failure() const { return _input->failure(); }

 private:
  const std::unique_ptr<TextInput> _input;
};

// Returns what is wrong with a part of a file without a character: ": has no characters there; it has ...".
std::string emptyPart(int64_t firstUs, int64_t lastUs);

class TextLine : public line::Line {
 public:
  enum class Clock {
    OfText,  // the text's times count from the program's start
    Live     // a program is still writing the text: its newest line is played at once
  };

  // Plays the characters that end from `fromUs` to `toUs`, in their own time; 0: to the end. Messages call the text
  // `name`.
  TextLine(std::string name, std::unique_ptr<TextInput> input, std::unique_ptr<line::LineReader> reader, Clock clock,
           uint64_t fromUs = 0, uint64_t toUs = 0);

  bool next(uint64_t nowUs, line::Character &character) override;
  uint64_t knownUs(uint64_t nowUs) const override;
  bool wait() override;
  bool canAdvanceTo(uint64_t us) override;
  bool finished(uint64_t nowUs) const override;
  bool isBroken() const override { return _clock == Clock::Live && !_reader->isComplete(); }
  std::string failure() const override { return _waiting.empty() ? _failure : ""; }
  std::string news() override { return std::exchange(_news, {}); }

 private:
  void fill(uint64_t nowUs);
  void read();
  void take(const std::string &line);
  void takeEnd();
  void setAges(size_t from);
  void keepPart(size_t from);
  void followLive(uint64_t nowUs);
  uint64_t playedUs(uint64_t endUs) const;

  const std::string _name;
  TextLines _lines;
  const std::unique_ptr<line::LineReader> _reader;
  const Clock _clock;
  line::PipeAges _ages;  // of a live text
  const uint64_t _fromUs;
  const uint64_t _toUs;
  std::deque<line::Character> _waiting;
  uint64_t _firstUs = 0;  // the first character's time, even if it is left out; 0: no characters yet
  uint64_t _newestUs = 0;
  uint64_t _lastUs = 0;  // when the last one was played
  bool _any = false;     // there were characters between _fromUs and _toUs
  bool _ended = false;
  int64_t _shiftUs = 0;  // from the text's times to the program's
  std::string _failure;
  std::string _news;
};

}  // namespace tool
