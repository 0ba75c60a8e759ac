#include "cli/Progress.h"

#include <unistd.h>

#include <chrono>
#include <cstdio>

#include "line/Format.h"
#include "line/capture/PackedFile.h"

namespace tool {

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds QuietFor(2000);
constexpr milliseconds Every(200);

Clock::time_point nextAt;
size_t shownColumns = 0;
bool isReading = false;  // a file, whose end is known

bool isSeen() {
  static const bool is = isatty(STDERR_FILENO) != 0;
  return is;
}

void show(const std::string &text) {
  const size_t columns = text.size();
  // The cursor goes back: a message that comes now covers the line.
  std::fprintf(stderr, "\r%s%*s\r", text.c_str(), columns < shownColumns ? static_cast<int>(shownColumns - columns) : 0, "");
  shownColumns = columns;
  nextAt = Clock::now() + Every;
}

void showFile(const std::string &name, int64_t at, int64_t size) {
  isReading = at < size;
  if (isReading && isProgressDue()) {
    show(line::format("%s: %d %% read", name.c_str(), static_cast<int>(100 * at / size)));
  }
}

}  // namespace

void watchProgress() {
  nextAt = Clock::now() + QuietFor;
  line::PackedFile::onRead = showFile;
}

bool isProgressDue() {
  return isSeen() && Clock::now() >= nextAt;
}

void showProgress(const std::string &text) {
  if (!isReading) {
    show(text);
  }
}

void hideProgress() {
  if (shownColumns > 0) {
    show("");
  }
  nextAt = Clock::now() + QuietFor;
}

}  // namespace tool
