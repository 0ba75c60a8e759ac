// Reads the text of a file, packed or not: see PackedFile and PlainText.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "line/capture/PackedFile.h"
#include "line/recording/PlainText.h"

namespace line {

class TextFile {
 public:
  // Reads the rest of `file`.
  explicit TextFile(PackedFile &file) : _file(file) {}

  // Waits for at least one character. Returns those received; nothing at the end and after a failure.
  std::string_view read();

  // Returns the first `size` characters, or all of them.
  std::string read(size_t size);

 private:
  PackedFile &_file;
  PlainText _plain;
  bool _atEnd = false;
};

// Calls `take` with each line of the rest of `file`, without its LF. Throws std::runtime_error if it cannot be read to
// its end.
void forEachLine(PackedFile &file, const std::function<void(std::string_view)> &take);

}  // namespace line
