#include "line/ports/ByteStream.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "line/system/System.h"

namespace line {

ByteStream::ByteStream(const std::string &name, int file, std::string begin, uint32_t characterUs, Pace pace)
    : _name(name == "-" ? "standard input" : name),
      _file(file),
      _begin(std::move(begin)),
      _reads(characterUs),
      _characterUs(characterUs),
      _pace(pace) {
  if (isatty(_file) != 0) {
    throw std::runtime_error(_name + ": is a terminal; pipe S.Bus bytes into it, as in: cat bytes.bin | sbus hex -");
  }
}

bool ByteStream::next(uint64_t nowUs, Character &character) {
  if (_waiting.empty() || (_pace == Pace::LineRate && _waiting.size() < ReadMax)) {
    fill(nowUs);
  }
  if (_waiting.empty() || (_pace != Pace::Live && _waiting.front().endUs > nowUs)) {
    return false;
  }
  character = _waiting.front();
  _waiting.pop_front();
  return true;
}

bool ByteStream::wait() {
  if (!_begin.empty() || _ended || !_waiting.empty()) {
    return false;
  }
  isReadable(_file, _reads.knownAfterMs());
  return true;
}

// Reads waiting bytes, if any. Ctrl-C interrupts the wait.
void ByteStream::fill(uint64_t nowUs) {
  if (!_begin.empty()) {
    const size_t count = std::min(_begin.size(), ReadMax);
    take(std::string_view(_begin).substr(0, count), nowUs);
    _begin.erase(0, count);
    return;
  }
  const bool isPatient = _pace == Pace::Patient;
  if (_ended || !isReadable(_file, isPatient ? -1 : 0)) {
    _reads.empty(isPatient ? 0 : nowUs);
    _ages.empty();
    return;
  }
  char bytes[ReadMax];
  const ssize_t count = read(_file, bytes, sizeof bytes);
  if (count < 0 && errno != EINTR && errno != EAGAIN) {
    _failure = _name + ": cannot be read (" + std::strerror(errno) + ")";
  }
  _ended = count == 0;
  if (count > 0) {
    take({bytes, static_cast<size_t>(count)}, nowUs);
  }
}

void ByteStream::take(std::string_view bytes, uint64_t nowUs) {
  const bool isLive = _pace == Pace::Live;
  _reads.begin(bytes.size(), _pace == Pace::Patient ? 0 : nowUs, isLive ? PortReads::UsualLatencyUs : UINT64_MAX);
  const uint64_t sinceUs = isLive ? _ages.came(bytes.size() * _characterUs) : 0;
  for (const char byte : bytes) {
    _waiting.push_back(_reads.next(static_cast<uint8_t>(byte)));
    _waiting.back().sinceUs = sinceUs;
    _lastEndUs = _waiting.back().endUs;
  }
}

bool ByteStream::finished(uint64_t nowUs) const { return _ended && nowUs >= _lastEndUs + TailUs; }

}  // namespace line
