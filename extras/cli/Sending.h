// Sends a line's characters through a port, or a pseudo-terminal: for `replay`, `simulate` and `send`.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "cli/Input.h"
#include "cli/options/Subcommand.h"

namespace tool {

class Sending {
 public:
  // Adds its options to a subcommand.
  explicit Sending(Subcommand &subcommand);

  // Sends to this port; to a pseudo-terminal if it is empty.
  explicit Sending(std::string port) : _to(std::move(port)) {}

  // Sends the line that `open` returns; with `loop` repeats this until Ctrl-C. A pseudo-terminal first waits for its
  // reader. Throws std::runtime_error.
  void run(const std::function<std::unique_ptr<Input>()> &open, bool loop) const;

 private:
  std::string _to;
};

}  // namespace tool
