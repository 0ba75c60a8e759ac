// A pseudo-terminal, for programs that read a serial port.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace line {

class PseudoTerminal {
 public:
  PseudoTerminal();  // throws std::runtime_error
  ~PseudoTerminal();
  PseudoTerminal(const PseudoTerminal &) = delete;
  PseudoTerminal &operator=(const PseudoTerminal &) = delete;

  const std::string &name() const { return _name; }  // what a reader opens

  bool hasReader() const;

  // Writes without waiting: bytes that no program reads are lost, as on the board's USB. Returns how many were written.
  size_t write(const uint8_t *bytes, size_t size);

  // Reads without waiting what was written to the other end, up to `size` bytes. Returns how many it has read.
  size_t read(uint8_t *bytes, size_t size);

 private:
  int _handle;
  std::string _name;
};

}  // namespace line
