#include "line/file/BytesReader.h"

#include "line/recording/Words.h"

namespace line {

namespace {

constexpr uint64_t SilenceUs = 3000;  // between lines, if their ends are known

std::string valuesOf(const TextBytes &bytes) {
  std::string values;
  for (const TextByte &byte : bytes) {
    values += static_cast<char>(byte.value);
  }
  return values;
}

// Returns the bytes of a text's first lines.
std::string bytesOf(std::string_view head, ByteText text) {
  TextBytes bytes;
  while (head.find('\n') != std::string_view::npos && text.line(takeLine(head), bytes).empty()) {
  }
  return valuesOf(bytes);
}

}  // namespace

BytesReader::BytesReader(std::string_view head, bool isText, const LineSettings &settings)
    : _isText(isText),
      _characterUs(settings.characterUs()),
      _text(isText ? head : std::string_view(), head.size() < FileHeadMax),
      _mangled(isText ? std::string_view(bytesOf(head, _text)) : head) {
}

std::string BytesReader::note() const {
  const char *const base = _text.base() == 10  ? "bytes in decimal, "
                           : _text.base() == 8 ? "bytes in octal, "
                           : _text.base() == 2 ? "bytes in binary, "
                                               : "bytes ";
  return std::string(base) + "without times: times are not known, frames are assumed to be " +
         (_text.hasFilledLines() ? "at the beginning of lines" : "back to back") +
         (_mangled.what().empty() ? "" : "; " + _mangled.what());
}

std::string BytesReader::line(std::string_view text, std::deque<Character> &characters) {
  _bytes.clear();
  if (!_isText) {
    undo(text);
    put(0, _bytes.size(), characters);
    return {};
  }
  const std::string wrong = _text.line(text, _bytes);
  putLine(characters);
  return wrong;
}

std::string BytesReader::finish(std::deque<Character> &characters) {
  _bytes.clear();
  _text.finish(_bytes);
  putLine(characters);
  return _last.endUs > 0 ? "" : "is empty: bytes of a line are expected";
}

// Sets the bytes as they were before another program changed them.
void BytesReader::undo(std::string_view bytes) {
  std::string undone;
  _mangled.undo(bytes, undone);
  _bytes.clear();
  for (const char c : undone) {
    _bytes.push_back({static_cast<uint8_t>(c), false});
  }
}

void BytesReader::putLine(std::deque<Character> &characters) {
  if (_mangled.isChanged()) {
    undo(valuesOf(_bytes));
  }
  const size_t frame = _text.hasFilledLines() ? frameAt(_bytes) : 0;
  put(0, frame, characters);
  put(frame, _bytes.size(), characters);
}

void BytesReader::put(size_t from, size_t to, std::deque<Character> &characters) {
  _last.endUs += _text.hasFilledLines() && from < to ? SilenceUs : 0;
  for (size_t i = from; i < to; i++) {
    _last.endUs += _characterUs;
    _last.value = _bytes[i].value;
    _last.bad = _bytes[i].bad;
    characters.push_back(_last);
  }
}

}  // namespace line
