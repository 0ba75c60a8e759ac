// The port or pseudo-terminal that bytes are sent to.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "line/ports/PseudoTerminal.h"
#include "line/ports/SendingPort.h"

namespace tool {

class Destination {
 public:
  // Opens a port, or with an empty name makes a pseudo-terminal and prints its name. Throws std::runtime_error.
  Destination(const std::string &to, const line::LineSettings &settings);

  // Waits until a program has opened the pseudo-terminal. Returns false if the end was asked for.
  bool waitForReader() const;

  // Gives a busy reader time to read the end: Linux throws away what waits in a pseudo-terminal that is closed.
  void finish() const;

  // Sends without waiting, and says on standard error if the port has gone, or is back. Returns how many bytes were
  // sent.
  size_t send(uint64_t nowUs, const std::vector<uint8_t> &bytes);

 private:
  std::unique_ptr<line::PseudoTerminal> _terminal;
  std::unique_ptr<line::SendingPort> _port;
};

}  // namespace tool
