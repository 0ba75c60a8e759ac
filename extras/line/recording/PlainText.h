// Converts a text file to UTF-8 with LF line ends: other programs write UTF-16, or end lines with CR.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace line {

// The byte order mark tells the encoding, and is removed; text without one is unchanged. If the first line ends with a
// single CR, all lines do.
class PlainText {
 public:
  // Takes the next bytes. Returns their text, which is valid until the next call.
  std::string_view put(std::string_view bytes);

  // Takes the end. Returns the rest of the text.
  std::string_view finish();

 private:
  enum class Encoding { Unknown, Bytes, Utf16Little, Utf16Big };
  enum class LineEnd { Unknown, Lf, Cr };

  bool findEncoding();
  void takeUtf16();
  void takeUnit(uint32_t unit);
  void endLines();

  Encoding _encoding = Encoding::Unknown;
  LineEnd _lineEnd = LineEnd::Unknown;
  std::string _bytes;    // incomplete: more are needed
  uint32_t _high = 0;    // the first half of a UTF-16 character
  std::string _text;     // the newest call's
  bool _heldCr = false;  // a CR, which LF may follow
};

}  // namespace line
