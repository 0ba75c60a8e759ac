// What can be at the other end of the wire.
#pragma once

#include <cstdint>
#include <string>

namespace host {

constexpr uint32_t CharacterUs = 120;  // 12 bits of 10 us: start, eight data bits, parity, two stop bits

struct Character {
  uint64_t endUs = 0;  // when its last bit was through, in microseconds since the program's start
  uint8_t value = 0;
  bool bad = false;  // its parity or a stop bit was wrong
};

class Line {
 public:
  virtual ~Line() = default;

  // The sketch has opened the port, for the first time, at `nowUs`.
  virtual void opened(uint64_t /*nowUs*/) {}

  // The next character that was through by `nowUs`, the oldest first; false if there is none.
  virtual bool next(uint64_t nowUs, Character &character) = 0;

  // True if nothing more will ever come.
  virtual bool finished(uint64_t /*nowUs*/) const { return false; }

  // Why the line broke down; empty if it did not.
  virtual std::string failure() const { return {}; }

  // True if the levels on the wire are those of S.Bus, so that the port must be told to invert them; false if something
  // in between may have inverted them already.
  virtual bool inverted() const { return true; }
};

}  // namespace host
