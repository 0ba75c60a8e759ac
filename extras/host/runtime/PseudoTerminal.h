// A pseudo-terminal, for programs that want to read the sketch's output from a serial port.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace host {

class PseudoTerminal {
 public:
  PseudoTerminal();  // throws std::runtime_error
  ~PseudoTerminal();
  PseudoTerminal(const PseudoTerminal &) = delete;
  PseudoTerminal &operator=(const PseudoTerminal &) = delete;

  const std::string &name() const { return _name; }  // what a reader opens

  // Never waits: what nobody reads is lost, as it is on the board's USB.
  void write(const uint8_t *bytes, size_t size);

 private:
  int _handle;
  std::string _name;
};

}  // namespace host
