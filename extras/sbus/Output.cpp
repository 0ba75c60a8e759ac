#include "Output.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "line/RecordingFile.h"

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

void writeTo(const std::string &name, const std::function<void(const Put &put)> &print) {
  if (name.empty()) {
    print(write);
    flush();
    return;
  }
  line::LineFile file(name);
  print([&file](const std::string &text) { file.write(text); });
  const std::string failure = file.finish();
  if (!failure.empty()) {
    throw std::runtime_error(failure);
  }
}

}  // namespace tool
