// Reads bytes without times, raw or as text: frames are assumed to follow each other directly, unless each has a line.
#pragma once

#include <string>

#include "line/LineSettings.h"
#include "line/file/ByteText.h"
#include "line/file/LineReader.h"
#include "line/file/Mangled.h"

namespace line {

class BytesReader : public LineReader {
 public:
  // `head`: the file's first bytes, or the text's first lines.
  BytesReader(std::string_view head, bool isText, const LineSettings &settings);

  std::string line(std::string_view text, std::deque<Character> &characters) override;
  std::string finish(std::deque<Character> &characters) override;
  bool takesBytes() const override { return !_isText; }

  // Returns what a reader should know of the bytes, or nothing.
  std::string note() const;

  // Returns why its frames would be wrong, or nothing.
  std::string error() const { return _mangled.isLost() ? _mangled.what() : ""; }

  // Returns what happened to them and what to do, unless it is undone; usually empty.
  std::string damage() const { return _mangled.isChanged() ? "" : _mangled.what(); }

 private:
  void undo(std::string_view bytes);
  void putLine(std::deque<Character> &characters);
  void put(size_t from, size_t to, std::deque<Character> &characters);

  const bool _isText;
  const uint32_t _characterUs;
  ByteText _text;
  Mangled _mangled;
  TextBytes _bytes;  // of a line
  Character _last;
};

}  // namespace line
