// Sends a line's characters through a port or a pseudo-terminal, for `send`.
#pragma once

#include <string>

#include "cli/Input.h"
#include "cli/options/Subcommand.h"

namespace tool {

class Sending {
 public:
  // Adds its options to a subcommand.
  explicit Sending(Subcommand &subcommand);

  // Returns the port; empty for a pseudo-terminal.
  const std::string &to() const { return _to; }

  // Sends this line. On a pseudo-terminal, first waits for a reader. Throws std::runtime_error.
  void run(Input &input) const;

 private:
  std::string _to;
};

}  // namespace tool
