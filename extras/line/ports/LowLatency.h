// Asks a port to deliver its bytes at once, and restores the setting at the end.
#pragma once

#include <optional>
#include <string>

namespace line {

class LowLatency {
 public:
  using Control = int (*)(int file, unsigned long request, ...);  // ioctl()

  // Does nothing if the adapter does not allow it, or on a system other than Linux.
  explicit LowLatency(int file, Control control = nullptr);
  ~LowLatency();
  LowLatency(const LowLatency &) = delete;
  LowLatency &operator=(const LowLatency &) = delete;

 private:
  const int _file = -1;
  const Control _control = nullptr;
  bool _isOurs = false;  // set by this object
};

// Returns the file with the latency timer of an FTDI adapter, in ms. `device` may be a link.
std::string latencyFile(const std::string &device);

// Returns the ms in that file; nothing if there is no such file.
std::optional<unsigned> latencyMs(const std::string &file);

}  // namespace line
