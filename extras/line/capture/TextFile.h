// Reads the text of a file, packed or not: see PackedFile and PlainText.
#pragma once

#include <string_view>

#include "line/capture/PackedFile.h"
#include "line/recording/PlainText.h"

namespace line {

class TextFile {
 public:
  // Reads the rest of `file`.
  explicit TextFile(PackedFile &file) : _file(file) {}

  // Waits for at least one character. Returns those received; nothing at the end and after a failure.
  std::string_view read() {
    std::string_view text;
    while (!_atEnd && text.empty()) {
      const std::string_view bytes = _file.read();
      _atEnd = bytes.empty();
      text = _atEnd ? _plain.finish() : _plain.put(bytes);
    }
    return text;
  }

 private:
  PackedFile &_file;
  PlainText _plain;
  bool _atEnd = false;
};

}  // namespace line
