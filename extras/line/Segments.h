// Cuts the line into stretches: frames, and the characters between them. A place is the number of characters before it.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "line/Line.h"
#include "sbus/FrameRules.h"
#include "sbus2/Slots.h"

namespace line {

// A rejected header.
struct Rejected {
  uint64_t at;  // its place
  sbus::Rejection why;
};

// A telemetry slot, with the end of its last character.
struct TimedSlot : sbus::Slot {
  uint64_t endUs;
};

// A piece of the line. Together the stretches hold each character once, in order.
struct Stretch {
  enum class Kind { Frame, Frame24, Extra, NoFrame };  // Extra: a frame with header 2F

  Kind kind = Kind::NoFrame;
  uint64_t at = 0;                    // place of its first character
  std::vector<Character> characters;  // 1 or more; a frame has none with an error
  std::vector<Rejected> rejected;     // of NoFrame; places count within the stretch
  std::vector<TimedSlot> slots;       // of NoFrame: its telemetry, if a frame follows

  bool isFrame() const { return kind != Kind::NoFrame; }
  uint64_t endUs() const { return characters.back().endUs; }
  uint32_t lateUs() const { return characters.back().lateUs; }
};

// Returns why a stretch is not a frame: "telemetry slots 1, 2"; "parity error (byte 12)"; without a character error
// "unused flags set (byte 10)", with the place of the header, or "no header". Returns "" for a frame.
std::string why(const Stretch &stretch);

// A stretch found by a decoder.
struct Piece {
  Stretch::Kind kind;
  uint64_t begin;
  uint64_t end;  // place of the first character after it
};

class Segments {
 public:
  static constexpr uint64_t KeptMax = 256;  // characters; a decoder holds fewer than 50 without errors

  // Calls `onStretch` with each stretch.
  explicit Segments(std::function<void(Stretch &)> onStretch) : _onStretch(std::move(onStretch)) {}

  void reset(uint32_t characterUs);
  void put(const Character &character) { _kept.push_back(character); }

  // Returns the place of the next character.
  uint64_t end() const { return _at + _kept.size(); }

  // Takes stretches found by a decoder. The characters between them are not frames.
  void cut(const std::vector<Piece> &pieces);

  // Cuts the characters before place `end`, which are not frames. The last ones wait for more characters or for a gap;
  // there were none up to `nowUs`.
  void cutBefore(uint64_t end, uint64_t nowUs);

  // Emits the rest.
  void finish();

 private:
  void cutRows(uint64_t end, uint64_t nowUs);
  void emit(Stretch::Kind kind, size_t count);

  const std::function<void(Stretch &)> _onStretch;
  std::deque<Character> _kept;  // not in a stretch yet
  uint64_t _at = 0;             // place of the first kept character
  uint32_t _characterUs = CharacterUs;
};

}  // namespace line
