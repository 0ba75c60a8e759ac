#if !defined(_WIN32)

#include <langinfo.h>
#include <locale.h>
#include <sys/ioctl.h>
#include <sys/select.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <ctime>

#include "line/system/System.h"

namespace line {

// Opens /dev/null in place of each closed standard stream.
void prepareStreams() {
  for (const int signal : {SIGPIPE, SIGXFSZ}) {  // the write fails instead
    std::signal(signal, SIG_IGN);
  }
  for (int stream = 0; stream <= 2; stream++) {
    if (fcntl(stream, F_GETFD) < 0) {
      open("/dev/null", stream == 0 ? O_WRONLY : O_RDONLY);  // using it fails, as before
    }
  }
}

size_t terminalColumns() {
  winsize size{};
  return isatty(STDOUT_FILENO) != 0 && ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 ? size_t{size.ws_col} : 0;
}

bool useTerminalLocale() {
  setlocale(LC_CTYPE, "");  // only this category: numbers keep their point
  return std::strcmp(nl_langinfo(CODESET), "UTF-8") == 0;
}

void onStop(void (*handler)(int signal)) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    std::signal(signal, handler);
  }
}

// Not poll(), which does not support devices on macOS.
bool isReadable(int file, int ms) {
  timeval time = {ms / 1000, ms % 1000 * 1000};
  fd_set files;
  FD_ZERO(&files);
  FD_SET(file, &files);
  return select(file + 1, &files, nullptr, nullptr, ms < 0 ? nullptr : &time) > 0;
}

uint64_t clockUs() {
#if defined(__linux__)
  constexpr clockid_t Clock = CLOCK_BOOTTIME;
#else
  constexpr clockid_t Clock = CLOCK_MONOTONIC;  // macOS: goes on while the PC sleeps
#endif
  timespec time{};
  clock_gettime(Clock, &time);
  return static_cast<uint64_t>(time.tv_sec) * 1000000 + static_cast<uint64_t>(time.tv_nsec) / 1000;
}

int openTemporary() {
  std::FILE *const stream = std::tmpfile();
  if (stream == nullptr) {
    return -1;
  }
  const int file = fcntl(fileno(stream), F_DUPFD_CLOEXEC, 3);
  std::fclose(stream);
  return file;
}

bool syncFile(int file) { return fsync(file) == 0 || errno == EINVAL || errno == EINTR; }

void syncFolder(const std::string &name) {
  const int folder = open(name.empty() ? "." : name.c_str(), O_RDONLY | O_CLOEXEC);
  if (folder >= 0) {
    fsync(folder);
    close(folder);
  }
}

// A name that does not exist is a port if it begins with /dev/, otherwise a missing file.
bool isPortName(const std::string &name) {
  struct stat status;
  return stat(name.c_str(), &status) == 0 ? S_ISCHR(status.st_mode) : name.rfind("/dev/", 0) == 0;
}

bool mayOpen(const std::string &port) { return access(port.c_str(), R_OK) == 0; }

}  // namespace line

#endif
