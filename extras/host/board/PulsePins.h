// Pins 2..5 with a receiver without S.Bus: servo pulses of CH1..CH4, and the sketch's interrupts.
#pragma once

#include <cstdint>

namespace host {

class PulsePins {
 public:
  // Connects the receiver. Every 20 ms it sends a pulse for one channel after the other; none while the radio is off.
  void connect();

  enum Edge : uint32_t { Change = 2, Falling = 3, Rising = 4 };  // as in Arduino.h
  void onEdge(uint32_t pin, void (*callback)(), Edge edge);
  bool isHigh(uint32_t pin) const;

  // Returns when the next pulse begins or ends, in us since the program's start; UINT64_MAX if nothing is connected.
  uint64_t nextUs() const { return _nextUs; }

  // Changes the pins up to that time. Two edges of a pin before its callback result in one call.
  void advance(uint64_t nowUs);
  // Calls the sketch's callbacks.
  void callBack();

 private:
  static constexpr uint32_t First = 2, Count = 4;
  static constexpr uint64_t PeriodUs = 20000, PitchUs = 2500;

  uint32_t flightMs() const;
  void plan();

  uint64_t _nextUs = UINT64_MAX;
  uint64_t _frame = 0;  // of the next edge, counted from 0
  uint32_t _edge = 0;   // the edge within its frame, 0..7
  bool _isHigh[Count] = {};
  bool _waits[Count] = {};
  void (*_callbacks[Count])() = {};
  Edge _edges[Count] = {};
};

}  // namespace host
