// A PPM sum signal, as trainer ports take it: one channel after the other on one wire. It does not use Arduino.
#pragma once

#include <sbus/Barrier.h>
#include <stdint.h>

class Ppm {
 public:
  static constexpr uint8_t Channels = 8;
  static constexpr int16_t Period = 22500;    // us, from one frame to the next
  static constexpr int16_t Pulse = 300;       // us, of each of the nine pulses between and around the channels
  static constexpr int16_t Shortest = 800;    // us, a channel: from the start of one pulse to the next
  static constexpr int16_t Longest = 2200;    // us
  static constexpr int16_t LeastSync = 4500;  // us, from the last pulse's start to the next frame, which it marks
  static constexpr int16_t Rest = 1000;  // us, the last part: when it begins, the next frame takes the newest channels
  static_assert(Period - Channels * Longest >= LeastSync, "A frame has its end with all sticks at theirs.");

  // A part of the signal: a pulse, or the time after it.
  struct Part {
    bool isPulse;
    uint16_t us;
  };

  // Sets the channels of the next frames, us, clamped to Shortest..Longest, and starts the signal. Call it from loop().
  void write(const int16_t us[]) {
    const uint8_t number = static_cast<uint8_t>(_number + 1);
    int16_t *const other = _set[number % 2];  // the interrupt may read the newest ones meanwhile
    for (uint8_t i = 0; i < Channels; i++) {
      other[i] = us[i] < Shortest ? Shortest : us[i] > Longest ? Longest : us[i];
    }
    sbus::barrier();
    _number = number;
    _isOn = true;
  }

  // Ends the signal after the frame that is being sent. Call it from loop().
  void stop() { _isOn = false; }

  // Returns the part after the one that begins: call it from the timer's interrupt, once for each part.
  Part next() {
    if (_at == 0) {
      if (!_isOn) {
        return {false, Rest};
      }
      uint8_t number;
      do {  // again, if loop() has written meanwhile: on an ESP32 it runs on another core
        number = _number;
        sbus::barrier();
        for (uint8_t i = 0; i < Channels; i++) {
          _sent[i] = _set[number % 2][i];
        }
        sbus::barrier();
      } while (number != _number);
      _left = Period;
    }
    const bool isPulse = _at % 2 == 0 && _at < Last;
    const int us = isPulse ? Pulse : _at < Last - 1 ? _sent[_at / 2] - Pulse : _at < Last ? _left - Rest : Rest;
    _left = static_cast<int16_t>(_left - us);
    _at = static_cast<uint8_t>(_at < Last ? _at + 1 : 0);
    return {isPulse, static_cast<uint16_t>(us)};
  }

 private:
  static constexpr uint8_t Last = 2 * Channels + 2;  // part of a frame: two follow the last pulse

  int16_t _set[2][Channels];
  int16_t _sent[Channels];
  int16_t _left = 0;             // us of the frame
  uint8_t _at = 0;               // part of the frame
  volatile uint8_t _number = 0;  // of the newest set, which is _set[_number % 2]
  volatile bool _isOn = false;
};
