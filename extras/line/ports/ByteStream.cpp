#include "ByteStream.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace line {

ByteStream::ByteStream(const std::string &name, uint32_t characterUs, bool patient)
    : _name(name == "-" ? "standard input" : name),
      _file(name == "-" ? STDIN_FILENO : open(name.c_str(), O_RDONLY | O_CLOEXEC)),
      _characterUs(characterUs),
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
  if (_at == _count) {
    if (!fill()) {
      return false;
    }
    _readUs = nowUs;
  }
  const uint64_t endUs = std::max(_lastEndUs + _characterUs, _readUs);
  if (endUs > nowUs) {
    return false;
  }
  character = Character();
  character.endUs = endUs;
  character.value = _bytes[_at++];
  _lastEndUs = endUs;
  return true;
}

// More bytes, if any wait. Ctrl-C ends the waiting.
bool ByteStream::fill() {
  pollfd state = {_file, POLLIN, 0};
  if (_ended || ::poll(&state, 1, _patient ? -1 : 0) != 1) {
    return false;
  }
  const ssize_t count = read(_file, _bytes, sizeof _bytes);
  _at = 0;
  _count = count > 0 ? static_cast<size_t>(count) : 0;
  if (count < 0 && errno != EINTR && errno != EAGAIN) {
    _failure = _name + ": cannot be read (" + std::strerror(errno) + ")";
  }
  _ended = count == 0;
  return _count > 0;
}

bool ByteStream::finished(uint64_t nowUs) const {
  return _ended && nowUs >= _lastEndUs + TailUs;
}

}  // namespace line
