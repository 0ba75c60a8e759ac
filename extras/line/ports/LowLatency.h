// Asks a port to hand its bytes over at once, and restores the setting in the end.
#pragma once

#include <optional>
#include <string>

namespace line {

class LowLatency {
 public:
  using Control = int (*)(int file, unsigned long request, ...);  // ioctl()

  // Does nothing where the system, such as any but Linux, or the adapter does not allow it.
  explicit LowLatency(int file, Control control = nullptr);
  ~LowLatency();
  LowLatency(const LowLatency &) = delete;
  LowLatency &operator=(const LowLatency &) = delete;

 private:
  const int _file = -1;
  const Control _control = nullptr;
  bool _isOurs = false;  // this object has set it
};

// Returns the file that holds the latency timer of an FTDI adapter, in ms. `device` may be a link.
std::string latencyFile(const std::string &device);

// Returns the ms in that file; none if there is no such file.
std::optional<unsigned> latencyMs(const std::string &file);

}  // namespace line
