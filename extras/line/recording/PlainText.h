// Turns the bytes of a text file into UTF-8 whose lines end with LF: other programs write UTF-16, or end lines with CR.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace line {

// The encoding is known by the byte order mark, which is left out; without a mark the text stays as it is. If the first
// line ends with a CR alone, all lines do.
class PlainText {
 public:
  // Takes the next bytes. Returns their text; it is valid until the next call.
  std::string_view put(std::string_view bytes);

  // Takes the end. Returns the rest of the text.
  std::string_view finish();

 private:
  enum class Encoding { Unknown, Bytes, Utf16Little, Utf16Big };
  enum class LineEnd { Unknown, Lf, Cr };

  bool findEncoding();
  void takeUtf16();
  void takeUnit(uint32_t unit);
  std::string_view ended(std::string_view text);

  Encoding _encoding = Encoding::Unknown;
  LineEnd _lineEnd = LineEnd::Unknown;
  std::string _bytes;  // that wait for more
  uint32_t _high = 0;  // the first half of a character of UTF-16
  std::string _text;
  bool _heldCr = false;  // a CR that may be followed by LF
};

}  // namespace line
