// Cuts the line into stretches: frames, and what lies between them. A place is the number of characters before it.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "line/Line.h"
#include "sbus/FrameRules.h"
#include "sbus/Slots.h"

namespace line {

// A rejected header: no frame begins with it.
struct Rejected {
  uint64_t at;  // its place
  sbus::Rejection why;
};

// A piece of the line. All stretches together are the line: each character once, in order.
// A telemetry slot, with the end of its last character.
struct TimedSlot : sbus::Slot {
  uint64_t endUs;
};

struct Stretch {
  enum class Kind { Frame, Frame24, Extra, NoFrame };  // Extra: a frame with header 2F

  Kind kind = Kind::NoFrame;
  uint64_t at = 0;                    // place of its first character
  std::vector<Character> characters;  // 1 or more; a frame has none with an error
  std::vector<Rejected> rejected;     // of NoFrame; places in the stretch
  std::vector<TimedSlot> slots;       // of NoFrame: the telemetry that it is, if a frame follows

  bool isFrame() const { return kind != Kind::NoFrame; }
  uint64_t endUs() const { return characters.back().endUs; }
  uint32_t lateUs() const { return characters.back().lateUs; }
};

// Returns why a stretch is no frame: "telemetry slots 1, 2"; "parity error (byte 12)"; without a character error
// "unused flags set (byte 10)", with the place of the header, or "no header". Returns "" for a frame.
std::string why(const Stretch &stretch);

// A stretch that a decoder has found.
struct Piece {
  Stretch::Kind kind;
  uint64_t begin;
  uint64_t end;  // place of the first character after it
};

class Segments {
 public:
  static constexpr uint64_t KeptMax = 256;  // characters; a decoder holds less than 50 without errors

  // Calls `say` with each stretch.
  explicit Segments(std::function<void(Stretch &)> say) : _say(std::move(say)) {}

  void reset(uint32_t characterUs);
  void put(const Character &character) { _kept.push_back(character); }

  // Returns the place of the next character.
  uint64_t end() const { return _at + _kept.size(); }

  // Takes stretches that a decoder has found: the characters before each are no frame.
  void cut(const std::vector<Piece> &pieces);

  // Cuts what stands before place `end`: it is no frame. Its last part waits for more characters, or for a gap: none
  // came up to `nowUs`.
  void cutBefore(uint64_t end, uint64_t nowUs);

  // Hands over all that still waits.
  void finish();

 private:
  void cutRows(uint64_t end, uint64_t nowUs);
  void say(Stretch::Kind kind, size_t count);

  const std::function<void(Stretch &)> _say;
  std::deque<Character> _kept;  // no stretch yet
  uint64_t _at = 0;             // place of the first kept character
  uint32_t _characterUs = CharacterUs;
};

}  // namespace line
