#include "cli/Output.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "line/recording/RecordingFile.h"
#include "line/system/System.h"

namespace tool {

namespace {

[[noreturn]] void fail() {
  if (line::isReaderGone(errno)) {
    std::_Exit(EXIT_FAILURE);
  }
  throw std::runtime_error(std::string("standard output cannot be written (") + std::strerror(errno) +
                           "); write it elsewhere");
}

}  // namespace

bool isTerminal() { return isatty(STDOUT_FILENO) != 0; }

void setLineByLine() { std::setvbuf(stdout, nullptr, line::LineBuffering, BUFSIZ); }

void write(const std::string &text) {
  // fwrite() does not report that an earlier flush failed; ferror() does.
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::ferror(stdout) != 0) {
    fail();
  }
}

void flush() {
  if (std::fflush(stdout) != 0) {
    fail();
  }
}

void writeTo(const std::string &name, File kind, const std::function<void(const Put &put)> &print) {
  if (name.empty() || name == "-") {
    print(write);
    flush();
    return;
  }
  std::error_code error;
  const bool isNew = !std::filesystem::exists(name, error);
  line::LineFile file(name, kind == File::New);
  const auto require = [](const std::string &failure) {
    if (!failure.empty()) {
      throw std::runtime_error(failure);
    }
  };
  try {
    print([&](const std::string &text) {
      file.write(text);
      require(file.failure());
    });
  } catch (...) {
    if (isNew && file.isEmpty()) {
      static_cast<void>(file.finish());
      std::filesystem::remove(name, error);
    }
    throw;
  }
  require(file.finish());
}

void rejectSameFile(const std::string &read, const std::string &written) {
  std::error_code error;
  if (std::filesystem::equivalent(read, written, error) && std::filesystem::is_regular_file(read, error)) {
    throw std::runtime_error(written + ": is also the input; name another file");
  }
}

}  // namespace tool
