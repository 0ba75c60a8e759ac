#include "line/ports/Unread.h"

#if defined(__linux__)
#include <sys/epoll.h>
#include <unistd.h>
#elif !defined(_WIN32)
#include <sys/ioctl.h>
#endif

namespace line {

#if defined(__linux__)

namespace {

bool isWoken(int poll) {
  epoll_event event{};
  return epoll_wait(poll, &event, 1, 0) == 1;
}

}  // namespace

Unread::Unread(int file) : _file(file), _poll(epoll_create1(EPOLL_CLOEXEC)) {
  epoll_event event{};
  event.events = EPOLLOUT | EPOLLET;  // each time that the writer is woken
  epoll_ctl(_poll, EPOLL_CTL_ADD, _file, &event);
}

Unread::~Unread() { close(_poll); }

void Unread::wrote() {
  isWoken(_poll);  // by the write itself
  _waits = true;
}

bool Unread::waits() {
  _waits = _waits && !isWoken(_poll);
  return _waits;
}

#else

Unread::Unread(int file) : _file(file), _poll(-1) {}

Unread::~Unread() = default;

void Unread::wrote() { _waits = true; }

bool Unread::waits() {
#if defined(_WIN32)
  _waits = false;
#else
  int count = 0;  // BSD counts the bytes that the other program has not read
  _waits = _waits && ioctl(_file, TIOCOUTQ, &count) == 0 && count > 0;
#endif
  return _waits;
}

#endif

}  // namespace line
