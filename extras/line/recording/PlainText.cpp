#include "line/recording/PlainText.h"

namespace line {

std::string_view PlainText::put(std::string_view bytes) {
  constexpr std::string_view Utf8Mark = "\xEF\xBB\xBF", Utf16Mark = "\xFF\xFE";
  if (_encoding == Encoding::Bytes) {
    return bytes;
  }
  _bytes += bytes;
  _text.clear();
  if (_encoding == Encoding::Unknown && _bytes.size() >= Utf8Mark.size()) {
    const bool isUtf16 = _bytes.compare(0, Utf16Mark.size(), Utf16Mark) == 0;
    const bool hasMark = _bytes.compare(0, Utf8Mark.size(), Utf8Mark) == 0;
    _encoding = isUtf16 ? Encoding::Utf16 : Encoding::Bytes;
    _bytes.erase(0, isUtf16 ? Utf16Mark.size() : hasMark ? Utf8Mark.size() : 0);
  }
  if (_encoding == Encoding::Bytes) {
    _text.swap(_bytes);
  }
  if (_encoding == Encoding::Utf16) {
    size_t i = 0;
    for (; i + 1 < _bytes.size(); i += 2) {
      _text += _bytes[i + 1] == 0 ? _bytes[i] : static_cast<char>(_bytes[i] | 0x80);
    }
    _bytes.erase(0, i);
  }
  return _text;
}

}  // namespace line
