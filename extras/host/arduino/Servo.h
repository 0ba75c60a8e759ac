// Servo: Arduino's Servo library. Nothing moves; at the end the program prints each pin's settings.
#pragma once

#include <stdint.h>

#define MIN_PULSE_WIDTH 544       // us
#define MAX_PULSE_WIDTH 2400      // us
#define DEFAULT_PULSE_WIDTH 1500  // us, until it is set

class Servo {
 public:
  // Starts pulses, clamped to `min`..`max` us. Returns the pin's number.
  uint8_t attach(int pin) { return attach(pin, MIN_PULSE_WIDTH, MAX_PULSE_WIDTH); }
  uint8_t attach(int pin, int min, int max);
  void detach() { _pin = NoPin; }
  bool attached() { return _pin != NoPin; }

  void write(int value);  // an angle, 0..180 degrees; from 544 on microseconds
  void writeMicroseconds(int us);
  int read();  // the angle
  int readMicroseconds() { return _us; }

 private:
  static constexpr int NoPin = -1;

  int _pin = NoPin;
  int _min = MIN_PULSE_WIDTH;
  int _max = MAX_PULSE_WIDTH;
  int _us = DEFAULT_PULSE_WIDTH;
};
