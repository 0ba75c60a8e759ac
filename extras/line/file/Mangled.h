// Recognises bytes that another program has changed on their way to a file.
#pragma once

#include <string>
#include <string_view>

namespace line {

struct Mangled {
  // Examines the first bytes of a file.
  explicit Mangled(std::string_view head);

  std::string what;     // what has happened to them; usually empty
  std::string remedy;   // how to avoid it
  bool isLost = false;  // their frames would have wrong channels
};

}  // namespace line
