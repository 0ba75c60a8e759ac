#if !defined(_WIN32)

#include "line/ports/PseudoTerminal.h"

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace line {

namespace {

// Turns off the echo and all conversions of bytes. Opening and closing it once also makes the system notice when no
// program has it open.
bool makeRaw(const char *name) {
  const int handle = open(name, O_RDWR | O_NOCTTY);
  if (handle < 0) {
    return false;
  }
  termios settings;
  bool done = tcgetattr(handle, &settings) == 0;
  if (done) {
    cfmakeraw(&settings);
    done = tcsetattr(handle, TCSANOW, &settings) == 0;
  }
  close(handle);
  return done;
}

}  // namespace

PseudoTerminal::PseudoTerminal() : _handle(posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
  const char *const name = _handle >= 0 && grantpt(_handle) == 0 && unlockpt(_handle) == 0 ? ptsname(_handle) : nullptr;
  if (name == nullptr || !makeRaw(name) || fcntl(_handle, F_SETFL, O_NONBLOCK) != 0) {
    const std::string reason = std::strerror(errno);
    if (_handle >= 0) {
      close(_handle);
    }
    throw std::runtime_error("the system provides no pseudo-terminal (" + reason + "); do without one");
  }
  _name = name;
  _unread.emplace(_handle);
}

PseudoTerminal::~PseudoTerminal() { close(_handle); }

bool PseudoTerminal::hasReader() const {
  pollfd state = {_handle, POLLOUT, 0};
  return poll(&state, 1, 0) == 1 && (state.revents & POLLHUP) == 0;
}

size_t PseudoTerminal::write(const uint8_t *bytes, size_t size) {
  const ssize_t count = hasReader() ? ::write(_handle, bytes, size) : 0;
  if (count <= 0) {
    return 0;  // it is full, or the reader has just left
  }
  _unread->wrote();
  return static_cast<size_t>(count);
}

size_t PseudoTerminal::read(uint8_t *bytes, size_t size) {
  const ssize_t count = ::read(_handle, bytes, size);
  return count > 0 ? static_cast<size_t>(count) : 0;  // otherwise nothing waits, or no program has it open
}

}  // namespace line

#endif
