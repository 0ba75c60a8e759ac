#include "line/ports/LowLatency.h"

#if defined(__linux__)
#include <linux/serial.h>
#include <sys/ioctl.h>
#endif

#include <filesystem>
#include <fstream>

namespace line {

#if defined(__linux__)

namespace {

constexpr int Flag = static_cast<int>(ASYNC_LOW_LATENCY);  // the settings' flags are an int

}  // namespace

LowLatency::LowLatency(int file, Control control)
    : _file(file), _control(control != nullptr ? control : Control{ioctl}) {
  serial_struct settings{};
  if (_control(_file, TIOCGSERIAL, &settings) == 0 && (settings.flags & Flag) == 0) {
    settings.flags |= Flag;
    _isOurs = _control(_file, TIOCSSERIAL, &settings) == 0;
  }
}

LowLatency::~LowLatency() {
  serial_struct settings{};
  if (_isOurs && _control(_file, TIOCGSERIAL, &settings) == 0) {
    settings.flags &= ~Flag;
    _control(_file, TIOCSSERIAL, &settings);
  }
}

#else

LowLatency::LowLatency(int /*file*/, Control /*control*/) {}

LowLatency::~LowLatency() = default;

#endif

std::string latencyFile(const std::string &device) {
  std::error_code error;
  const std::filesystem::path port = std::filesystem::canonical(device, error);
  const std::string name = (error ? std::filesystem::path(device) : port).filename().string();
  return "/sys/bus/usb-serial/devices/" + name + "/latency_timer";
}

std::optional<unsigned> latencyMs(const std::string &file) {
  unsigned ms = 0;
  std::ifstream in(file);
  return in >> ms ? std::optional<unsigned>(ms) : std::nullopt;
}

}  // namespace line
