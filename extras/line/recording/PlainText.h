// Converts a text file to plain text: other programs write UTF-16, or a mark before UTF-8.
#pragma once

#include <string>
#include <string_view>

namespace line {

// The byte order mark tells the encoding, and is removed; text without one is unchanged. Of UTF-16, as Windows writes
// it, each character beyond ASCII becomes one byte from 80 on.
class PlainText {
 public:
  // Takes the next bytes. Returns their text, which is valid until the next call.
  std::string_view put(std::string_view bytes);

  // Takes the end. Returns the rest of the text.
  std::string_view finish() const { return _encoding == Encoding::Unknown ? std::string_view(_bytes) : ""; }

 private:
  enum class Encoding { Unknown, Bytes, Utf16 };

  Encoding _encoding = Encoding::Unknown;
  std::string _bytes;  // incomplete: more are needed
  std::string _text;   // the newest call's
};

}  // namespace line
