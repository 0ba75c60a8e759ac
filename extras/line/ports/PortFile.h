// An open serial port of this PC; or a pseudo-terminal, which has no rate and no format.
#pragma once

#include <libserialport.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "line/LineSettings.h"

namespace line {

class PortFile {
 public:
  enum class Way { Read, Write };

  // Opens the port with 8 data bits; the polarity is set in the adapter. Throws std::runtime_error, which says what is
  // wrong and what to do.
  PortFile(const std::string &device, const LineSettings &settings, Way way);
  ~PortFile();
  PortFile(const PortFile &) = delete;
  PortFile &operator=(const PortFile &) = delete;

  // Makes read() put FF 00 before a character with an error, and FF before each FF; discards what has come until now.
  // Returns false if the system does not report parity and framing errors.
  bool markErrors();

  // Reads without waiting, up to `size` bytes, 3 at least. Returns how many; -1 if the port has gone.
  std::ptrdiff_t read(uint8_t *bytes, size_t size);

  // Writes without waiting. Returns how many bytes; -1 if the port has gone.
  std::ptrdiff_t write(const uint8_t *bytes, size_t size);

  // Waits up to `ms` until bytes have come.
  void wait(int ms);

  // Returns the file descriptor; -1 on Windows.
  int file() const;

 private:
  struct Close {
    void operator()(sp_port *port) const;
  };

  void openPseudoTerminal(const std::string &device, Way way);
  std::ptrdiff_t waiting();

  std::unique_ptr<sp_port, Close> _port;  // null for a pseudo-terminal
  int _file = -1;                         // a pseudo-terminal's
  bool _errors = false;                   // Windows: among the characters that wait
};

// Returns true for the name of a pseudo-terminal, which libserialport does not know.
inline bool isPseudoTerminal(const std::string &name) {
  return name.rfind("/dev/pts/", 0) == 0 || name.rfind("/dev/ttys", 0) == 0;  // Linux, macOS
}

// Returns why `device` could not be opened. `error`, `message`: the system's.
std::string openError(const std::string &device, int error, const std::string &message);

}  // namespace line
