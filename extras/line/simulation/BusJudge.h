// Judges what a board sends on an S.BUS2 wire: the right slot at the right time, and nothing else.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>

#include "line/Line.h"
#include "sbus2/Slots.h"

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
  void frame(uint64_t endUs, uint8_t end) {
    idleUntil(endUs);
    _frameEndUs = endUs;
    _end = end;
    _hasFrame = true;
  }

  static constexpr uint64_t NoFrame = UINT64_MAX;

  // Takes a character that the board has sent or begun to send. `frameUs`: the beginning of a frame that it destroys.
  void heard(const Character &character, uint32_t characterUs, bool isCollided, uint64_t frameUs = NoFrame) {
    const uint64_t startUs = character.endUs - characterUs;
    idleUntil(startUs);
    if (_characters == 0) {
      _startUs = startUs;
      _id = character.value;
      _isCollided = false;
      _frameUs = NoFrame;
    }
    _characters++;
    _lastUs = character.endUs;
    _isCollided = _isCollided || isCollided;
    _frameUs = std::min(_frameUs, frameUs);
  }

  // Takes the time up to which the wire was idle.
  void idleUntil(uint64_t nowUs) {
    if (_characters > 0 && nowUs > _lastUs + GapUs) {
      close();
    }
  }

  // Notes that the board's TX holds the wire.
  void held() { _counts.held++; }

  const Counts &counts() const { return _counts; }

  // Return the deviation of right answers from their slots' times, us; 0 before the first.
  int64_t earliestUs() const { return _earliestUs; }
  int64_t latestUs() const { return _latestUs; }

  // Returns the largest deviation of an announced answer from its slot's time, us.
  int64_t mostOffUs() const { return _mostOffUs; }

  // Returns "12 answers in their slots, -3..7 us off; 1 late, 2 in slot 0".
  std::string text() const {
    std::string text = std::to_string(_counts.right) + " answers in their slots";
    if (_counts.right > 0) {
      text += ", " + std::to_string(_earliestUs) + ".." + std::to_string(_latestUs) + " us off";
    }
    const struct {
      unsigned long count;
      const char *what;
    } faults[] = {{_counts.early, "early"},
                  {_counts.late, "late"},
                  {_counts.receivers, "in slot 0"},
                  {_counts.unannounced, "not announced"},
                  {_counts.torn, "torn"},
                  {_counts.collided, "collided"},
                  {_counts.unseen, "in a frame's first character"},
                  {_counts.held, "while TX held the wire"},
                  {_counts.met, "met by a frame"},
                  {_counts.cut, "cut short"}};
    const char *separator = "; ";
    for (const auto &fault : faults) {
      if (fault.count > 0) {
        text += separator + std::to_string(fault.count) + " " + fault.what;
        separator = ", ";
      }
    }
    return text;
  }

 private:
  static constexpr uint32_t UnseenUs = CharacterUs + 50;  // from a frame's start: its first character, and a poll
  static constexpr uint32_t GapUs = 30;                   // a longer gap separates two answers

  void close() {
    if (_isCollided && _frameUs != NoFrame && _frameUs + UnseenUs > _startUs) {
      (_frameUs >= _startUs ? _counts.met : _counts.unseen)++;
    } else if (_isCollided) {
      _counts.collided++;
    } else if (_characters > sbus::SlotSize || !sbus::isSlotId(_id)) {
      _counts.torn++;
    } else {
      closeSlot();
    }
    _characters = 0;
  }
  void closeSlot() {
    if (sbus::slotOfId(_id) == 0) {
      _counts.receivers++;
    } else if (!_hasFrame || !sbus::endsVariant(_end, sbus::SlotsVariant) ||
               sbus::slotOfId(_id) / sbus::SlotsOfGroup != sbus::firstSlotOf(_end) / sbus::SlotsOfGroup) {
      _counts.unannounced++;
    } else {
      const uint64_t dueUs = _frameEndUs + FirstSlotUs + SlotPitchUs * (sbus::slotOfId(_id) % sbus::SlotsOfGroup);
      const int64_t offUs = static_cast<int64_t>(_startUs) - static_cast<int64_t>(dueUs);
      _mostOffUs = std::max(_mostOffUs, offUs < 0 ? -offUs : offUs);
      if (offUs < -SlotToleranceUs) {
        _counts.early++;
      } else if (offUs > SlotToleranceUs) {
        _counts.late++;
      } else if (_characters < sbus::SlotSize) {
        _counts.cut++;
      } else {
        _earliestUs = _counts.right == 0 ? offUs : std::min(_earliestUs, offUs);
        _latestUs = _counts.right == 0 ? offUs : std::max(_latestUs, offUs);
        _counts.right++;
      }
    }
  }

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
