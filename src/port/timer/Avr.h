/// @file
/// An AVR's timer for an SBus2Sensor: AvrSensor.cpp. DecodeSBusBackground has compare B of timer 0: AvrBackground.cpp.
/// Two interrupts are two files, since a vector is linked with all of its file.
// SlotTimer.h includes this.
#pragma once

#define SBUS_SLOT_TIMER

namespace sbus {

// AVR: compare B of a timer, in steps of 4 us. It polls the port, often while a frame's end is expected. A Mega has a
// timer 4, which neither tone() nor IRremote takes, and Servo only for more than 36 servos; analogWrite() of its pins
// (6, 7, 8) does not work beside it. Other AVRs take timer 2: tone() and analogWrite() of its pins (Uno: 3, 11) do not
// work. (Timer 0, of millis(), is a PWM: there a new compare value waits for the overflow.)
class SlotTimer : public NoSlotTimer {
 public:
  using Lock = FlagLock;  // an AVR reads 32 bits one by one
  static bool isLocked() { return Lock::isLocked; }

  using NoSlotTimer::start;
  static bool start(HardwareSerial &port, void (*due)(void *), void *context);
  static void stop(void *context);
  static void callIn(uint32_t us);
  static bool isLate() { return _isLate; }
  static bool send(const uint8_t *characters, size_t size);
  static void tick();  // the interrupt

 private:
  static bool _isLate;
};

}  // namespace sbus
