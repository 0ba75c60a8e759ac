/// @file
/// EncodeSBus: sends Futaba S.Bus through a hardware serial port; the mirror of DecodeSBus.
#pragma once

#include <Arduino.h>

#include "SBusPort.h"
#include "sbus/Frame.h"

/// One sender on one serial port, whose transmit buffer must take 25 bytes. Two calls do it:
///
///     EncodeSBus sBus(Serial2);
///     void setup() { sBus.begin(); }
///     void loop() { sBus.write(channels, failsafe, lostFrame); }
///
/// A DecodeSBus may listen on the same port: begin() and end() that one, not this. Call all methods from setup(),
/// loop() or serialEventN(), none from an interrupt.
class EncodeSBus {
 public:
  /// `serial` must outlive the object. Nothing is opened yet.
  explicit EncodeSBus(HardwareSerial &serial) : _serial(serial) {}

  /// Opens the port with SERIAL_SBUS (8E2, inverted), 100000 baud unless told; Fast S.Bus is 200000. A core without
  /// SERIAL_SBUS opens SERIAL_8E2, and the line needs an inverter. Nothing is sent before write().
  void begin(unsigned long baud = sbus::Baud);

  /// begin() with another format: begin(100000, SERIAL_8E2) for an uninverted line.
  void begin(unsigned long baud, uint32_t config);

  /// Closes the port. The known cores first send what they still hold, and wait for it: up to 8 ms. Do not call write()
  /// after it: the AVR's port does not know that it is closed.
  void end();

  /// Time from one frame to the next: 0..65535 us, 9000 unless told. A frame takes 3000 us (1500 at 200000 baud) and
  /// receivers need a pause after it, so set no less than 4000 (2000).
  void setPeriod(uint16_t us) { _period = us; }

  /// Sends a frame if it is time for one and the port takes all of it at once; never waits, and never sends a part.
  /// Call it in every loop(). True if it has sent; the first frame is sent at once.
  ///
  /// `channels` are 18: CH1..CH16, clamped to 2047, then CH17 and CH18, where any but 0 is sent as 1. The period stays
  /// exact while a loop period is less than half of the pause; after a longer one it begins anew.
  bool write(const uint16_t channels[], bool failsafe, bool lostFrame);

 private:
  HardwareSerial &_serial;
  uint32_t _last = 0;  // us, when it was time for the last frame
  uint16_t _period = 9000;
  bool _sent = false;
};
