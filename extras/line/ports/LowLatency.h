// Asks a port to hand its bytes over at once, and restores the setting in the end.
#pragma once

#include <optional>
#include <string>

namespace line {

class LowLatency {
 public:
  using Control = int (*)(int file, unsigned long request, ...);  // ioctl()

  // Does nothing where the system or the adapter does not allow it.
  LowLatency(int file, Control control);
  ~LowLatency();
  LowLatency(const LowLatency &) = delete;
  LowLatency &operator=(const LowLatency &) = delete;

 private:
  const int _file;
  const Control _control;
  bool _isOurs = false;  // this object has set it
};

// Returns the file that holds the latency timer of an FTDI adapter, in ms. `device` may be a link.
std::string latencyFile(const std::string &device);

// Returns the ms in that file; none if there is no such file.
std::optional<unsigned> latencyMs(const std::string &file);

}  // namespace line
