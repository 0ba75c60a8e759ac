// A stand-in for Paul Stoffregen's elapsedMillis library, for machines on which it is not installed: variables that
// count up by themselves, in milliseconds or microseconds.
#pragma once

#include <Arduino.h>

template <uint32_t (*now)()>
class ElapsedTime {
 public:
  ElapsedTime() : _start(now()) {}
  ElapsedTime(unsigned long value) : _start(now() - static_cast<uint32_t>(value)) {}

  // Counts in 32 bits, so it survives the clock's wrap-around on a host whose unsigned long has 64.
  operator unsigned long() const { return now() - _start; }

  ElapsedTime &operator=(unsigned long value) { return *this = ElapsedTime(value); }
  ElapsedTime &operator+=(unsigned long value) {
    _start -= static_cast<uint32_t>(value);
    return *this;
  }
  ElapsedTime &operator-=(unsigned long value) {
    _start += static_cast<uint32_t>(value);
    return *this;
  }

  ElapsedTime operator+(int value) const { return plus(static_cast<uint32_t>(value)); }
  ElapsedTime operator+(unsigned value) const { return plus(value); }
  ElapsedTime operator+(long value) const { return plus(static_cast<uint32_t>(value)); }
  ElapsedTime operator+(unsigned long value) const { return plus(static_cast<uint32_t>(value)); }
  ElapsedTime operator-(int value) const { return plus(0 - static_cast<uint32_t>(value)); }
  ElapsedTime operator-(unsigned value) const { return plus(0 - value); }
  ElapsedTime operator-(long value) const { return plus(0 - static_cast<uint32_t>(value)); }
  ElapsedTime operator-(unsigned long value) const { return plus(0 - static_cast<uint32_t>(value)); }

 private:
  ElapsedTime plus(uint32_t value) const {
    ElapsedTime sum = *this;
    sum._start -= value;
    return sum;
  }

  uint32_t _start;
};

typedef ElapsedTime<millis> elapsedMillis;
typedef ElapsedTime<micros> elapsedMicros;
