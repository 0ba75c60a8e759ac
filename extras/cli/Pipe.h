// A source that may be a pipe: standard input or a FIFO. It carries a live line or a file of any kind.
#pragma once

#include <optional>
#include <string>

#include "cli/FileSource.h"

namespace tool {

class Pipe {
 public:
  // `name` is a file, a FIFO, or "-" for standard input. Throws std::runtime_error if a FIFO cannot be opened.
  explicit Pipe(std::string name);
  ~Pipe();
  Pipe(const Pipe &) = delete;
  Pipe &operator=(const Pipe &) = delete;

  // Returns true for standard input and for a FIFO.
  static bool isPipe(const std::string &name);

  // What a pipe carries. Line: bytes, or the rows that a sketch prints. Text: it can be played while it is being
  // written. File: it has to be read to its end first.
  enum class Content { Line, Text, File };

  // Waits for the first bytes, for at most `seconds`; 0: until Ctrl-C. A pipe without bytes counts as a line.
  Content content(double seconds);

  // Returns true if a live line or a text is a file after all, since it comes at once. Call it after content().
  bool isFileAtOnce();

  // Returns true if bytes that come at once are a file's that another program has changed: only a file's reader undoes
  // it.
  bool isMangled();

  // Returns the file; for a pipe, a copy of everything in it. Throws std::runtime_error.
  FileName wholeFile();

  // Returns true if it has ended without a byte.
  bool isEmpty() const { return _begin.empty() && _ended; }

  // Returns true if the live line consists of a sketch's rows.
  bool hasRows() const { return _hasRows; }

  line::FileKind textKind() const { return *_textKind; }

  // For a live line or a text: its descriptor, and the bytes already read from it.
  int descriptor() const { return _file; }
  const std::string &begin() const { return _begin; }

 private:
  bool readMore(int ms);

  // Returns what the bytes so far are; nothing while that is uncertain. `isPause`: no byte has come for a while.
  // `isOver`: none will be waited for.
  std::optional<Content> contentSoFar(bool isPause, bool isOver);

  const std::string _name;
  int _file = -1;  // -1: not a pipe
  std::string _begin;
  bool _ended = false;
  bool _hasRows = false;
  std::optional<line::FileKind> _textKind;
  int _copy = -1;
};

}  // namespace tool
