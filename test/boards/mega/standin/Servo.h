// A stand-in for Arduino's Servo library, which Debian does not have: real pulses, timed by timer 5 as that library
// does it on a Mega, one pulse after the other, every 20 ms; up to eight servos. It has less: no angles, and attach()
// takes no limits.
#pragma once

#include <stdint.h>

constexpr uint8_t ServoMax = 8;  // eight pulses of 2.4 ms have to fit into 20 ms

class Servo {
 public:
  Servo();

  // Pulses begin, of 1500 us unless told. Returns the servo's number, or 255 if there are eight already.
  uint8_t attach(int pin);

  // No pulse begins any more.
  void detach();
  bool attached() const;

  // From the next pulse on; before attach() the first one. Taken to the nearest of 544..2400 us.
  void writeMicroseconds(int us);
  int readMicroseconds() const;

 private:
  uint8_t _number;
};
