// An open serial port of this PC, or a pseudo-terminal, which has neither rate nor format.
#pragma once

#include <libserialport.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "line/LineSettings.h"
#include "line/ports/Unread.h"

namespace line {

class PortFile {
 public:
  enum class Way { Read, Write };

  // Opens the port with 8 data bits; the polarity is set in the adapter. Throws std::runtime_error that says what is
  // wrong and what to do.
  PortFile(const std::string &device, const LineSettings &settings, Way way);
  ~PortFile();
  PortFile(const PortFile &) = delete;
  PortFile &operator=(const PortFile &) = delete;

  // Makes read() put FF 00 before a character with an error, and FF before each FF; discards the bytes received so far.
  // Returns false if the system does not report parity and framing errors.
  bool markErrors();

  // Reads up to `size` bytes, at least 3, without waiting. Returns their number; -1 if the port is gone.
  std::ptrdiff_t read(uint8_t *bytes, size_t size);

  // Writes without waiting. Returns the number of bytes; -1 if the port is gone.
  std::ptrdiff_t write(const uint8_t *bytes, size_t size);

  // Returns true if bytes that were written have not left yet. On a pseudo-terminal see Unread.
  bool holdsBytes();

  // Returns true if holdsBytes() may be wrong: see Unread.
  bool mayMissReads() const { return _unread.has_value(); }

  // Discards these bytes. On a pseudo-terminal they stay.
  void discard();

  // Waits up to `ms` for bytes.
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
  std::optional<Unread> _unread;          // of a pseudo-terminal to write to
  bool _errors = false;                   // Windows: waiting characters have errors
};

// Returns true for the name of a pseudo-terminal, which libserialport does not support.
inline bool isPseudoTerminal(const std::string &name) {
  return name.rfind("/dev/pts/", 0) == 0 || name.rfind("/dev/ttys", 0) == 0;  // Linux, macOS
}

// Returns why `device` could not be opened. `error`, `message`: the system's.
std::string openError(const std::string &device, int error, const std::string &message);

}  // namespace line
