#include "line/ports/ByteStream.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace line {

ByteStream::ByteStream(const std::string &name, uint32_t characterUs, bool patient)
    : _name(name == "-" ? "standard input" : name),
      _file(name == "-" ? STDIN_FILENO : open(name.c_str(), O_RDONLY | O_CLOEXEC)),
      _reads(characterUs),
      _patient(patient) {
  if (_file < 0) {
    throw std::runtime_error(_name + ": cannot be opened (" + std::strerror(errno) + "); name a pipe that can be read");
  }
  if (isatty(_file) != 0) {
    throw std::runtime_error(_name + ": is a terminal; pipe S.Bus bytes into it, as in: cat bytes.bin | sbus hex -");
  }
}

ByteStream::~ByteStream() {
  if (_file != STDIN_FILENO) {
    close(_file);
  }
}

bool ByteStream::next(uint64_t nowUs, Character &character) {
  if (_waiting.empty() || (!_patient && _waiting.size() < ReadMax)) {
    fill(nowUs);
  }
  if (_waiting.empty() || _waiting.front().endUs > nowUs) {
    return false;
  }
  character = _waiting.front();
  _waiting.pop_front();
  return true;
}

bool ByteStream::wait() {
  pollfd state = {_file, POLLIN, 0};
  return !_ended && _waiting.empty() && ::poll(&state, 1, _reads.knownAfterMs()) >= 0;
}

// Reads more bytes, if any wait. Ctrl-C ends the waiting.
void ByteStream::fill(uint64_t nowUs) {
  pollfd state = {_file, POLLIN, 0};
  if (_ended || ::poll(&state, 1, _patient ? -1 : 0) != 1) {
    _reads.empty(_patient ? 0 : nowUs);
    return;
  }
  uint8_t bytes[ReadMax];
  const ssize_t count = read(_file, bytes, sizeof bytes);
  if (count < 0 && errno != EINTR && errno != EAGAIN) {
    _failure = _name + ": cannot be read (" + std::strerror(errno) + ")";
  }
  _ended = count == 0;
  if (count > 0) {
    _reads.begin(static_cast<size_t>(count), _patient ? 0 : nowUs);
  }
  for (ssize_t i = 0; i < count; i++) {
    _waiting.push_back(_reads.next(bytes[i]));
    _lastEndUs = _waiting.back().endUs;
  }
}

bool ByteStream::finished(uint64_t nowUs) const {
  return _ended && nowUs >= _lastEndUs + TailUs;
}

}  // namespace line
