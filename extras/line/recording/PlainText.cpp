#include "line/recording/PlainText.h"

#include <algorithm>
#include <utility>

namespace line {

namespace {

constexpr std::string_view Utf8Mark = "\xEF\xBB\xBF";
constexpr uint32_t Replacement = 0xFFFD;  // for half a character

void appendUtf8(std::string &text, uint32_t c) {
  if (c < 0x80) {
    text += static_cast<char>(c);
    return;
  }
  const int more = c < 0x800 ? 1 : c < 0x10000 ? 2 : 3;  // bytes
  text += static_cast<char>((0xF0 << (3 - more) & 0xFF) | c >> (6 * more));
  for (int i = more - 1; i >= 0; i--) {
    text += static_cast<char>(0x80 | (c >> (6 * i) & 0x3F));
  }
}

}  // namespace

std::string_view PlainText::put(std::string_view bytes) {
  if (_encoding == Encoding::Bytes && _lineEnd == LineEnd::Lf) {
    return bytes;
  }
  _text.clear();
  _bytes += bytes;
  if (_encoding != Encoding::Unknown || findEncoding()) {
    _encoding == Encoding::Bytes ? _text.swap(_bytes) : takeUtf16();
    endLines();
  }
  return _text;
}

std::string_view PlainText::finish() {
  _text.clear();
  if (_encoding <= Encoding::Bytes) {  // half a UTF-16 unit is not text
    _text.swap(_bytes);
    endLines();
  }
  _text += std::exchange(_heldCr, false) ? "\n" : "";
  return _text;
}

// Returns false if more bytes are needed.
bool PlainText::findEncoding() {
  const std::string_view little("\xFF\xFE", 2);
  const std::string_view big("\xFE\xFF", 2);
  if (_bytes.size() < Utf8Mark.size() &&
      (Utf8Mark.substr(0, _bytes.size()) == _bytes || _bytes.size() < little.size())) {
    return false;
  }
  const std::string_view begin = std::string_view(_bytes).substr(0, little.size());
  _encoding = begin == little ? Encoding::Utf16Little : begin == big ? Encoding::Utf16Big : Encoding::Bytes;
  const bool hasMark = _bytes.compare(0, Utf8Mark.size(), Utf8Mark) == 0;
  _bytes.erase(0, _encoding != Encoding::Bytes ? little.size() : hasMark ? Utf8Mark.size() : 0);
  return true;
}

void PlainText::takeUtf16() {
  size_t i = 0;
  for (; i + 1 < _bytes.size(); i += 2) {
    const auto first = static_cast<unsigned char>(_bytes[i]);
    const auto second = static_cast<unsigned char>(_bytes[i + 1]);
    const unsigned low = _encoding == Encoding::Utf16Little ? first : second;
    const unsigned high = _encoding == Encoding::Utf16Little ? second : first;
    takeUnit(high << 8 | low);
  }
  _bytes.erase(0, i);
}

void PlainText::takeUnit(uint32_t unit) {
  const bool isSecond = unit >= 0xDC00 && unit < 0xE000;
  if (_high != 0 && !isSecond) {
    appendUtf8(_text, Replacement);
  }
  const uint32_t high = std::exchange(_high, 0);
  if (unit >= 0xD800 && unit < 0xDC00) {
    _high = unit;
  } else if (isSecond) {
    appendUtf8(_text, high != 0 ? 0x10000 + ((high - 0xD800) << 10) + (unit - 0xDC00) : Replacement);
  } else {
    appendUtf8(_text, unit);
  }
}

// Ends the lines of _text with LF.
void PlainText::endLines() {
  if (_lineEnd == LineEnd::Unknown) {
    _text.insert(0, std::exchange(_heldCr, false) ? "\r" : "");
    const size_t first = _text.find_first_of("\r\n");
    if (first != std::string::npos && first + 1 == _text.size() && _text[first] == '\r') {
      _text.pop_back();
      _heldCr = true;
    } else if (first != std::string::npos) {
      _lineEnd = _text[first] == '\r' && _text[first + 1] != '\n' ? LineEnd::Cr : LineEnd::Lf;
    }
  }
  if (_lineEnd == LineEnd::Cr) {
    std::replace(_text.begin(), _text.end(), '\r', '\n');
  }
}

}  // namespace line
