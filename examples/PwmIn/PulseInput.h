// Measures the servo pulses of one channel of a receiver without S.Bus. It does not use Arduino.
#pragma once

#include <stdint.h>

// A pulse counts if it has 800..2200 us, and if the line was LOW for 2 ms before and after it. So a spike spoils the
// pulse that it falls into, or next to: its longer half might pass for a pulse.
class PulseInput {
 public:
  static constexpr uint16_t Shortest = 800;    // us
  static constexpr uint16_t Longest = 2200;    // us
  static constexpr uint16_t Still = 2000;      // us
  static constexpr uint32_t Oldest = 1000000;  // us

  // Takes a look at the pin at `now`, us, from this pin's interrupt, or if not `isOwn` from that of another one: if
  // several pins change at once, the first interrupt finds them all, and those that come after it would be late.
  void look(bool isHigh, uint32_t now, bool isOwn) {
    if (isHigh != _isHigh || (isOwn && !_isAhead)) {
      change(isHigh, now);
      _isAhead = !isOwn;
    } else if (isOwn) {
      _isAhead = false;
    }
  }

  // Takes a change of the pin at `now`, us, after which it `isHigh`.
  void change(bool isHigh, uint32_t now) {
    update(now);
    if (isHigh == _isHigh) {  // it changed twice before the interrupt looked
      _isGood = false;
      _waiting = 0;
    } else if (isHigh) {
      _isGood = now - _changed >= Still;
      _waiting = 0;
    } else {
      const uint32_t us = now - _changed;
      _waiting = static_cast<uint16_t>(_isGood && us >= Shortest && us <= Longest ? us : 0);
    }
    _isHigh = isHigh;
    _changed = now;
  }

  // Brings width() and age() up to `now`, us. Call it with interrupts off, at least once an hour.
  void update(uint32_t now) {
    if (_waiting != 0 && now - _changed >= Still) {
      _width = _waiting;
      _waiting = 0;
      _ended = _changed;
      _age = 0;
    }
    if (_age < Oldest) {
      _age = now - _ended;
    }
  }

  // Returns the newest pulse that counts, us; 0 before the first.
  uint16_t width() const { return _width; }

  // Returns how long ago that pulse ended, us; Oldest or more if that is long ago, and before the first.
  uint32_t age() const { return _age; }

 private:
  uint32_t _changed = 0;  // us, the last change
  uint32_t _ended = 0;    // us
  uint32_t _age = Oldest;
  uint16_t _width = 0;
  uint16_t _waiting = 0;  // us, a pulse that counts if no other change comes; 0: none
  bool _isHigh = false;
  bool _isGood = false;   // the current pulse
  bool _isAhead = false;  // another pin's interrupt has seen the last change: this pin's is still to come
};
