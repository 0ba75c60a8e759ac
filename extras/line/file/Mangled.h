// Recognises bytes that another program has changed on their way to a file.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace line {

class Mangled {
 public:
  // Examines the first bytes of a file.
  explicit Mangled(std::string_view head);

  // Returns what has happened to them and, if it cannot be undone, how to avoid it; usually empty.
  const std::string &what() const { return _what; }

  // Returns true if their frames would have wrong channels.
  bool isLost() const { return _isLost; }

  // Returns true if undo() changes them.
  bool isChanged() const { return _change != Change::None; }

  // Appends the next bytes as they were.
  void undo(std::string_view bytes, std::string &undone);

 private:
  enum class Change { None, Utf8, CrLf };

  Change _change = Change::None;
  std::string _what;
  bool _isLost = false;
  uint8_t _held = 0;  // the byte before; 0 if it does not matter
};

}  // namespace line
