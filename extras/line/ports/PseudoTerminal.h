// A pseudo-terminal, for programs that read a serial port.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "line/ports/Unread.h"

namespace line {

class PseudoTerminal {
 public:
  PseudoTerminal();  // throws std::runtime_error
  ~PseudoTerminal();
  PseudoTerminal(const PseudoTerminal &) = delete;
  PseudoTerminal &operator=(const PseudoTerminal &) = delete;

  const std::string &name() const { return _name; }  // for the reader to open

  bool hasReader() const;

  // Writes without waiting; bytes that no program reads are lost, as on a board's USB. Returns the number written.
  size_t write(const uint8_t *bytes, size_t size);

  // Returns true if the reader has not read the bytes written last. See Unread.
  bool holdsBytes() { return _unread && _unread->waits(); }

  // Reads up to `size` bytes written to the other end, without waiting. Returns the number read.
  size_t read(uint8_t *bytes, size_t size);

 private:
  int _handle;
  std::string _name;
  std::optional<Unread> _unread;
};

}  // namespace line
