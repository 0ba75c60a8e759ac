// Reads bytes without times, raw or as text: frames are assumed to follow each other directly, unless each has a line.
#pragma once

#include <string>

#include "line/LineSettings.h"
#include "line/file/ByteText.h"
#include "line/file/LineReader.h"

namespace line {

class BytesReader : public LineReader {
 public:
  // `head`: the file's first bytes, or the text's first lines.
  BytesReader(std::string_view head, bool isText, const LineSettings &settings)
      : _isText(isText),
        _characterUs(settings.characterUs()),
        _text(isText ? head : std::string_view(), head.size() < FileHeadMax) {}

  std::string line(std::string_view text, std::deque<Character> &characters) override;
  std::string finish(std::deque<Character> & /*characters*/) override {
    return _last.endUs > 0 ? "" : "is empty: bytes of a line are expected";
  }
  bool takesBytes() const override { return !_isText; }

  // Returns what a user should know of the bytes.
  std::string note() const;

 private:
  void put(const TextBytes &bytes, size_t from, size_t to, std::deque<Character> &characters);

  const bool _isText;
  const uint32_t _characterUs;
  const ByteText _text;
  Character _last;
};

}  // namespace line
