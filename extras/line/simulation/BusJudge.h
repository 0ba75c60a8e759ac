// Judges what a board sends on an S.BUS2 wire: the right slot at the right time, and nothing else.
#pragma once

#include <cstdint>
#include <string>

#include "line/Line.h"
#include "sbus/Slots.h"

namespace line {

// The times of the slots, from the end of the frame's last stop bit: measured on a Futaba R7008SB (PX4-Autopilot,
// test_data/sbus2_r7008SB.txt, eight of eight) and on a line with eight occupied slots (mstrens/oXs_on_RP2040).
constexpr uint32_t FirstSlotUs = 2030;
constexpr uint32_t SlotPitchUs = 660;
constexpr int64_t SlotToleranceUs = 50;

class BusJudge {
 public:
  // An answer is a run of characters without a gap.
  struct Counts {
    unsigned long right = 0;        // a slot of the announced group, within the tolerance
    unsigned long early = 0;        // in a slot of the announced group, but too early
    unsigned long late = 0;         // in a slot of the announced group, but too late
    unsigned long receivers = 0;    // in slot 0, the receiver's
    unsigned long unannounced = 0;  // in a slot of another group, or after an end byte that announces none
    unsigned long torn = 0;         // not a slot's characters, which begin with its ID
    unsigned long collided = 0;     // on the wire at the same time as something else
    unsigned long unseen = 0;       // during a frame's first character, which few ports can detect
    unsigned long held = 0;         // TX held the wire HIGH at rest: every character is destroyed
    // Not the board's fault, or harmless.
    unsigned long met = 0;  // a frame began during the answer
    unsigned long cut = 0;  // in a slot's time, but only one or two characters, which a receiver discards

    unsigned long wrong() const { return early + late + receivers + unannounced + torn + collided + unseen + held; }
  };

  // Takes the end of a receiver's frame, with its end byte.
  void frame(uint64_t endUs, uint8_t end);

  static constexpr uint64_t NoFrame = UINT64_MAX;

  // Takes a character that the board has sent or begun to send. `frameUs`: the beginning of a frame that it destroys.
  void heard(const Character &character, uint32_t characterUs, bool isCollided, uint64_t frameUs = NoFrame);

  // Takes the time up to which the wire was idle.
  void idleUntil(uint64_t nowUs);

  // Notes that the board's TX holds the wire.
  void held() { _counts.held++; }

  const Counts &counts() const { return _counts; }

  // Return the deviation of right answers from their slots' times, us; 0 before the first.
  int64_t earliestUs() const { return _earliestUs; }
  int64_t latestUs() const { return _latestUs; }

  // Returns the largest deviation of an announced answer from its slot's time, us.
  int64_t mostOffUs() const { return _mostOffUs; }

  // Returns "12 answers in their slots, -3..7 us off; 1 late, 2 in slot 0".
  std::string text() const;

 private:
  static constexpr uint32_t UnseenUs = CharacterUs + 50;  // from a frame's start: its first character, and a poll
  static constexpr uint32_t GapUs = 30;                   // a longer gap separates two answers

  void close();
  void closeSlot();

  uint64_t _frameEndUs = 0;
  uint8_t _end = 0;
  bool _hasFrame = false;
  // The current answer, if it has characters.
  uint64_t _startUs = 0;
  uint64_t _lastUs = 0;  // the end of its last character
  unsigned _characters = 0;
  uint8_t _id = 0;
  bool _isCollided = false;
  uint64_t _frameUs = NoFrame;
  Counts _counts;
  int64_t _earliestUs = 0;
  int64_t _latestUs = 0;
  int64_t _mostOffUs = 0;
};

}  // namespace line
