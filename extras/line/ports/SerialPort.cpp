#include "SerialPort.h"

#include <poll.h>
#include <sys/stat.h>
#include <termios.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <stdexcept>

#include "sbus/Frame.h"

namespace line {

namespace {

constexpr uint64_t PollUs = 200;  // two characters: asking the system more often finds nothing

std::string lastError() {
  char *const message = sp_last_error_message();
  const std::string text = message != nullptr && message[0] != '\0' ? message : "not supported";
  sp_free_error_message(message);
  return text;
}

// Why `device` could not be opened, `error` being what the system says.
std::string openError(const std::string &device, int error, const std::string &message) {
  struct stat status;
  if (stat(device.c_str(), &status) != 0 && errno == ENOENT) {
    return device + ": there is no such port; plug the adapter in and look for its name in /dev/serial/by-id";
  }
  switch (error) {
    case EACCES:
      return device + ": no permission; join the group that may use it (sudo usermod -aG dialout $USER), log in again";
    case EBUSY:
      return device + ": in use; close the other program that has it open";
    default:
      return device + ": not a serial port that can be opened (" + message + "); name the adapter's port";
  }
}

bool configure(sp_port *port) {
  return sp_set_baudrate(port, static_cast<int>(sbus::Baud)) == SP_OK && sp_set_bits(port, 8) == SP_OK &&
         sp_set_parity(port, SP_PARITY_EVEN) == SP_OK && sp_set_stopbits(port, 2) == SP_OK &&
         sp_set_flowcontrol(port, SP_FLOWCONTROL_NONE) == SP_OK;
}

// libserialport does not look at parity. The board drops bad characters, so they must be told from good ones.
bool markBadCharacters(int handle) {
  termios settings;
  if (tcgetattr(handle, &settings) != 0) {
    return false;
  }
  settings.c_iflag &= ~static_cast<tcflag_t>(IGNPAR | IGNBRK | BRKINT);
  settings.c_iflag |= INPCK | PARMRK;
  return tcsetattr(handle, TCSANOW, &settings) == 0;
}

// Some drivers take any rate and then run at the nearest one that they have.
bool runsAtSBusBaud(sp_port *port) {
  sp_port_config *config = nullptr;
  int baud = 0;
  if (sp_new_config(&config) != SP_OK) {
    return false;
  }
  const bool known = sp_get_config(port, config) == SP_OK && sp_get_config_baudrate(config, &baud) == SP_OK;
  sp_free_config(config);
  constexpr int Wanted = static_cast<int>(sbus::Baud);
  return known && std::abs(baud - Wanted) <= Wanted / 50;  // 2 %: what 12 bits can bear
}

}  // namespace

SerialPort::SerialPort(const std::string &device) : _device(device), _port(nullptr, sp_free_port) {
  sp_port *port = nullptr;
  if (sp_get_port_by_name(device.c_str(), &port) != SP_OK) {
    throw std::runtime_error(openError(device, 0, "unknown to the system"));
  }
  _port.reset(port);  // closes it, too
  if (sp_open(port, SP_MODE_READ) != SP_OK) {
    const int error = sp_last_error_code();
    throw std::runtime_error(openError(device, error, lastError()));
  }
  if (!configure(port) || sp_get_port_handle(port, &_handle) != SP_OK || !markBadCharacters(_handle) ||
      !runsAtSBusBaud(port)) {
    throw std::runtime_error(device + ": this adapter cannot do 100000 baud, 8E2; take one that can, as FTDI's do");
  }
  sp_flush(port, SP_BUF_INPUT);
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
  const int count = sp_nonblocking_read(_port.get(), bytes, sizeof bytes);
  for (int i = 0; i < count; i++) {
    take(bytes[i], nowUs);
  }
  // A port that has gone reads as one that is silent; only poll() tells them apart.
  pollfd state = {_handle, POLLIN, 0};
  if (count < 0 || (::poll(&state, 1, 0) == 1 && (state.revents & (POLLHUP | POLLERR | POLLNVAL)) != 0)) {
    _failure = _device + ": the port has gone; plug the adapter in again and start anew";
  }
}

// USB brings characters in bursts. They go on at the pace of the line, or a burst would overrun the board's buffer.
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
  _lastEndUs = std::max(_lastEndUs + CharacterUs, nowUs);
  character.endUs = _lastEndUs;
  _waiting.push_back(character);
}

}  // namespace line
