#include "SketchInput.h"

#include <poll.h>
#include <unistd.h>

#include <cerrno>

namespace host {

namespace {

constexpr uint64_t PollUs = 1000;  // polling more often would cost CPU time; typing is slower
constexpr int PatienceMs = 1000;   // of the PC's time

}  // namespace

int SketchInput::available(uint64_t nowUs) {
  fetch(nowUs);
  return static_cast<int>(_count);
}

int SketchInput::peek(uint64_t nowUs) { return available(nowUs) > 0 ? _buffer[_first] : -1; }

int SketchInput::read(uint64_t nowUs) {
  uint8_t byte;
  return read(nowUs, &byte, 1) == 1 ? byte : -1;
}

int SketchInput::read(uint64_t nowUs, uint8_t *buffer, size_t size) {
  fetch(nowUs);
  size_t done = 0;
  for (; done < size && _count > 0; done++) {
    buffer[done] = _buffer[_first];
    _first = (_first + 1) % BufferSize;
    _count--;
  }
  return static_cast<int>(done);
}

void SketchInput::fetch(uint64_t nowUs) {
  if (!_begun || room() == 0) {
    return;
  }
  const bool due = nowUs >= _nextPollUs;
  if (due) {
    _nextPollUs = nowUs + PollUs;
  }
  if (!_ended && (due || _patient)) {
    fetchFromStandardInput();
  }
}

void SketchInput::fetchFromStandardInput() {
  do {
    pollfd state = {STDIN_FILENO, POLLIN, 0};
    if (poll(&state, 1, _patient ? PatienceMs : 0) <= 0) {
      _patient = false;
      return;
    }
    uint8_t bytes[BufferSize];
    const ssize_t count = ::read(STDIN_FILENO, bytes, room());
    if (count < 0 && (errno == EINTR || errno == EAGAIN || errno == EIO)) {
      return;  // EIO: another program is using the terminal
    }
    if (count <= 0) {
      _ended = true;
      return;
    }
    take(bytes, static_cast<size_t>(count));
  } while (_patient && room() > 0);
}

void SketchInput::take(const uint8_t *bytes, size_t size) {
  for (size_t i = 0; i < size; i++) {
    _buffer[(_first + _count) % BufferSize] = bytes[i];
    _count++;
  }
}

}  // namespace host
