// The clock of the simulated board, in microseconds since the program's start.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <thread>

#include "line/system/System.h"

namespace host {

// The sketch's time advances only when something takes time: a call of loop(), a delay, reading the clock. With
// Pace::Real the sketch then waits for the PC's clock. So both paces call loop() at the same times, and a PC that stops
// for 50 ms costs no bytes: the sketch catches up.
class Clock {
 public:
  enum class Pace { Simulated, Real };

  explicit Clock(Pace pace = Pace::Simulated) : _pace(pace) {}

  // Advances the time by `us`.
  void spend(uint64_t us) {
    _nowUs += us;
    if (_pace == Pace::Real && _nowUs >= _nextSleepUs) {
      std::this_thread::sleep_for(std::chrono::microseconds(_nowUs - std::min(_nowUs, line::clockUs() - _beganUs)));
      _nextSleepUs = _nowUs + SleepUs;
    }
  }

  // Returns the time since the program's start.
  uint64_t nowUs() const { return _nowUs; }

  // Returns the sketch's time, which wraps at 32 bits.
  uint32_t millis() const { return static_cast<uint32_t>(_nowUs / 1000); }
  uint32_t micros() const { return static_cast<uint32_t>(_nowUs); }

 private:
  static constexpr uint64_t SleepUs = 1000;  // sleeping more often costs CPU time and makes nothing visibly smoother

  Pace _pace;
  uint64_t _nowUs = 0;
  uint64_t _nextSleepUs = 0;
  uint64_t _beganUs = line::clockUs();  // as line::SerialPort, whose times must not be ahead after the PC has slept
};

}  // namespace host
