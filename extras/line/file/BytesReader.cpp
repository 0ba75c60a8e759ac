#include "line/file/BytesReader.h"

namespace line {

std::string BytesReader::note() const {
  return std::string(_text.isDecimal() ? "bytes in decimal, " : "bytes ") +
         "without times: times are not known, frames are assumed to be " +
         (_text.hasFilledLines() ? "at the beginning of lines" : "back to back");
}

std::string BytesReader::line(std::string_view text, std::deque<Character> &characters) {
  TextBytes bytes;
  std::string wrong;
  if (_isText) {
    wrong = _text.line(text, bytes);
  } else {
    for (const char c : text) {
      bytes.push_back({static_cast<uint8_t>(c), false});
    }
  }
  const size_t frame = _text.hasFilledLines() ? frameAt(bytes) : 0;
  put(bytes, 0, frame, characters);
  put(bytes, frame, bytes.size(), characters);
  return wrong;
}

void BytesReader::put(const TextBytes &bytes, size_t from, size_t to, std::deque<Character> &characters) {
  constexpr uint64_t SilenceUs = 3000;  // between lines, if their ends are known
  _last.endUs += _text.hasFilledLines() && from < to ? SilenceUs : 0;
  for (size_t i = from; i < to; i++) {
    _last.endUs += _characterUs;
    _last.value = bytes[i].value;
    _last.bad = bytes[i].bad;
    characters.push_back(_last);
  }
}

}  // namespace line
