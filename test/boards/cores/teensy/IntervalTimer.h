// github.com/PaulStoffregen/cores 7f107ee: teensy4/IntervalTimer.h and .cpp, teensy3's; as far as the library calls it.
#pragma once

#include <stdint.h>

class IntervalTimer {
 public:
  ~IntervalTimer() { end(); }
  bool begin(void (*function)(), int us);
  void priority(uint8_t level);
  void end();

 private:
  int _channel = -1;
  uint8_t _priority = 128;
};
