// A port or pseudo-terminal to send bytes to.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "line/ports/PseudoTerminal.h"
#include "line/ports/Reopened.h"

namespace tool {

class Destination {
 public:
  // Opens a port; if `to` is empty, creates a pseudo-terminal and prints its name. Throws std::runtime_error.
  Destination(const std::string &to, const line::LineSettings &settings);

  // Waits until a program has opened the pseudo-terminal, for at most `seconds`; 0: without a limit. Returns false
  // after Ctrl-C. Throws std::runtime_error if no program has.
  bool waitForReader(double seconds) const;

  // Gives a busy reader time to read the end: Linux discards unread bytes when a pseudo-terminal is closed.
  void finish() const;

  // Returns true if bytes that were sent have not left yet, or the reader of a pseudo-terminal has not read them.
  bool holdsBytes(uint64_t nowUs);

  // Returns true if this may be wrong: see line::Unread.
  bool mayMissReads(uint64_t nowUs);

  // Discards these bytes, if the port can.
  void discard(uint64_t nowUs);

  // Returns true if the port is gone and will not come back: the other end of a pseudo-terminal.
  bool isGone() const { return _port && _port->finished(); }

  // Sends without waiting. Reports on standard error that the port is gone, or back. Returns the number of bytes sent.
  size_t send(uint64_t nowUs, const std::vector<uint8_t> &bytes);

 private:
  std::unique_ptr<line::PseudoTerminal> _terminal;
  std::unique_ptr<line::SendingPort> _port;
};

}  // namespace tool
