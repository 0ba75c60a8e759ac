#include "SerialPort.h"

#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <stdexcept>

namespace line {

namespace {

constexpr uint64_t PollUs = 200;  // two characters: asking the system more often finds nothing

// libserialport does not look at parity. The board drops bad characters, so they must be told from good ones.
bool markBadCharacters(int file) {
  termios settings;
  if (tcgetattr(file, &settings) != 0) {
    return false;
  }
  settings.c_iflag &= ~static_cast<tcflag_t>(IGNPAR | IGNBRK | BRKINT);
  settings.c_iflag |= INPCK | PARMRK;
  return tcsetattr(file, TCSANOW, &settings) == 0;
}

}  // namespace

SerialPort::SerialPort(const std::string &device, const LineSettings &settings)
    : _device(device), _port(device, settings, PortFile::Way::Read), _characterUs(settings.characterUs()) {
  if (!markBadCharacters(_port.file())) {
    throw std::runtime_error(device + ": the system does not tell bad characters from good ones; name another port");
  }
  tcflush(_port.file(), TCIFLUSH);
}

bool SerialPort::next(uint64_t nowUs, Character &character) {
  if (nowUs >= _nextPollUs && _failure.empty()) {
    _nextPollUs = nowUs + PollUs;
    poll(nowUs);
  }
  if (_waiting.empty() || _waiting.front().endUs > nowUs) {
    return false;
  }
  character = _waiting.front();
  _waiting.pop_front();
  return true;
}

void SerialPort::poll(uint64_t nowUs) {
  uint8_t bytes[256];
  const ssize_t count = read(_port.file(), bytes, sizeof bytes);
  const bool failed = count < 0 && errno != EAGAIN && errno != EINTR;
  for (ssize_t i = 0; i < count; i++) {
    take(bytes[i], nowUs);
  }
  // A port that has gone reads as one that is silent; only poll() tells them apart.
  pollfd state = {_port.file(), POLLIN, 0};
  if (failed || (::poll(&state, 1, 0) == 1 && (state.revents & (POLLHUP | POLLERR | POLLNVAL)) != 0)) {
    _failure = _device + ": the port has gone; plug the adapter in again and start anew";
  }
}

// USB brings a frame in pieces. They go on at the pace of the line, or they would overrun the board's buffer, and so
// much later that the next piece is there before they have gone: else there were pauses within frames. A pause on the
// line that is shorter is lost, which a decoder can bear.
void SerialPort::take(uint8_t byte, uint64_t nowUs) {
  Character character;
  character.value = byte;
  switch (_mark) {
    case Mark::None:
      if (byte == 0xFF) {
        _mark = Mark::Escape;
        return;
      }
      break;
    case Mark::Escape:
      if (byte == 0x00) {
        _mark = Mark::Bad;
        return;
      }
      break;
    case Mark::Bad:
      character.bad = true;
      break;
  }
  _mark = Mark::None;
  _lastEndUs = nowUs <= _lastEndUs ? _lastEndUs + _characterUs : nowUs + LaterUs;
  character.endUs = _lastEndUs;
  _waiting.push_back(character);
}

}  // namespace line
