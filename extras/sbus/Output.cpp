#include "Output.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

namespace tool {

namespace {

[[noreturn]] void fail() {
  if (errno == EPIPE) {
    std::_Exit(EXIT_FAILURE);
  }
  throw std::runtime_error(std::string("standard output cannot be written (") + std::strerror(errno) +
                           "); write it elsewhere");
}

}  // namespace

bool isTerminal() {
  return isatty(STDOUT_FILENO) != 0;
}

void setLineByLine() {
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
}

void write(const std::string &text) {
  // Of what went wrong while a buffer was emptied, fwrite() says nothing.
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::ferror(stdout) != 0) {
    fail();
  }
}

void flush() {
  if (std::fflush(stdout) != 0) {
    fail();
  }
}

}  // namespace tool
