// A word of a text that is wrong, for the message that says so.
#pragma once

#include <string>
#include <string_view>

namespace line {

// As it may be shown on a terminal: in quotation marks, the beginning of a long one.
inline std::string quoted(std::string_view word) {
  constexpr size_t Shown = 20;
  std::string text = "\"";
  for (const char c : word.substr(0, Shown)) {
    text += c >= ' ' && c <= '~' ? c : '?';
  }
  return text + (word.size() > Shown ? "...\"" : "\"");
}

}  // namespace line
