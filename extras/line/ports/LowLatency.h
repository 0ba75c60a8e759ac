// Asks a port to hand its bytes over at once, and puts that back.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace line {

class LowLatency {
 public:
  using Control = int (*)(int file, unsigned long request, ...);  // ioctl()

  // Where the system or the adapter does not allow it, nothing happens.
  LowLatency(int file, Control control);
  ~LowLatency();
  LowLatency(const LowLatency &) = delete;
  LowLatency &operator=(const LowLatency &) = delete;

 private:
  const int _file;
  const Control _control;
  bool _isOurs = false;  // it was not asked for before
};

// Of an adapter with a latency timer, FTDI's: the file that tells it in ms. `device` may be a link.
std::string latencyFile(const std::string &device);

// Returns what that file tells; none if there is no such file.
std::optional<unsigned> latencyMs(const std::string &file);

}  // namespace line
