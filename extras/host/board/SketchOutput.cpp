#include "SketchOutput.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace host {

namespace {

// Ends the program, since standard output is gone; without a message if just its reader has ended, such as head.
[[noreturn]] void leave() {
  if (errno != EPIPE) {
    std::fprintf(stderr, "standard output: %s\n", std::strerror(errno));
  }
  std::_Exit(EXIT_FAILURE);
}

}  // namespace

size_t SketchOutput::write(const uint8_t *bytes, size_t size) {
  if (!_begun) {
    _lostBeforeBegin += size;
    return 0;
  }
  for (size_t i = 0; i < size; i++) {
    _lines += _rows.put(bytes[i]);
  }
  if (std::fwrite(bytes, 1, size, stdout) != size) {
    leave();
  }
  if (_lineByLine && (std::memchr(bytes, '\n', size) != nullptr || std::memchr(bytes, '\r', size) != nullptr)) {
    flush();
  }
  return size;
}

void SketchOutput::flush() {
  if (std::fflush(stdout) != 0) {
    leave();
  }
}

}  // namespace host
