// Reads bytes without times, raw or as text: frames are assumed to follow each other directly, unless something else
// regularly stands between them. Tells whether they are a line's.
#pragma once

#include <string>
#include <vector>

#include "line/LineSettings.h"
#include "line/file/ByteText.h"
#include "line/file/FilledFrames.h"
#include "line/file/LineReader.h"

namespace line {

class BytesReader : public LineReader {
 public:
  // `head`: the file's first bytes, or the text's first lines.
  BytesReader(std::string_view head, bool isText, const LineSettings &settings);

  std::string line(std::string_view text, std::deque<Character> &characters) override;
  std::string finish(std::deque<Character> &characters) override;
  bool takesBytes() const override { return !_isText; }

  // Returns true if a receiver sent the frames of the head.
  bool hasFrames() const { return _found.areLine(); }

  // Returns the baud rate at which a port has read a line, if another than its own; otherwise 0.
  unsigned long readAtBaud() const { return _found.baud; }

  // Returns false if no receiver sent the frames: the head has some by chance, or none though it is long.
  bool mayBeLine() const { return hasFrames() || readAtBaud() != 0 || (_found.frames == 0 && !_isLong); }

  // Returns why it may not, and what is expected.
  std::string why() const;

  // Returns what a user should know of the bytes.
  std::string note() const;

 private:
  // The frames of the head.
  struct Found {
    size_t frames = 0;
    size_t bytes = 0;  // of all
    size_t taken = 0;  // by frames and telemetry
    size_t alike = 0;  // frames that hardly differ from the one before; the first one of sticks is one

    unsigned long baud = 0;  // see Observer::readAtBaud()

    // Returns true if a receiver sent them. Numbers look like a frame by chance, here and there: it is as long as one,
    // its first byte is 0F and its last one 00.
    bool areLine() const;
  };

  void examine(std::string_view head);
  Found framesOf(const TextBytes &bytes, FilledFrames filled) const;
  std::string bytesOf(std::string_view text, TextBytes &bytes) const;

  const bool _isText;
  const uint32_t _characterUs;
  ByteText _text;
  FilledFrames _filled;
  Found _found;
  const bool _isLong;  // the head is only the beginning
  Character _last;
};

}  // namespace line
