// EncodeSBus: sends Futaba S.Bus through a hardware serial port; the mirror of DecodeSBus.
//
//   EncodeSBus sBus(Serial2);
//   void loop() { sBus.write(channels, failsafe, lostFrame); }
#pragma once

#include <Arduino.h>

#include "SBusPort.h"
#include "sbus/Frame.h"

// One sender on one serial port, whose transmit buffer must take 25 bytes. A DecodeSBus may listen on the same port:
// begin() and end() that one, not this. All methods are for setup(), loop() or serialEventN(), not for interrupts.
class EncodeSBus {
 public:
  // `serial` must outlive the object. Nothing is opened yet.
  explicit EncodeSBus(HardwareSerial &serial) : _serial(serial) {}

  // Opens the port: 100000 baud unless told (Fast S.Bus: 200000), SERIAL_SBUS (8E2, inverted); SERIAL_8E2 on a core
  // that has none, and the line then needs an inverter. Nothing is sent before write().
  void begin(unsigned long baud = sbus::Baud);

  // begin() with another format: begin(100000, SERIAL_8E2) for an uninverted line.
  void begin(unsigned long baud, uint32_t config);

  // Closes the port. The cores known send first what they still hold, and wait for it: up to 8 ms. Do not call write()
  // behind it: a port of the AVR's core does not know that it is closed.
  void end();

  // Time from one frame to the next: 0..65535 us, 9000 unless told (FrSky's R-XSR). A frame itself takes 3000 us, 1500
  // at 200000 baud, and receivers of it need a pause: less than 4000 (2000) is asking for trouble.
  void setPeriod(uint16_t us) { _period = us; }

  // Sends a frame if it is due, and if the port can take all of it at once: it never waits, and never sends a part.
  // Call it in every pass of loop(): the frames then come on time, without adding up what loop() takes, as long as it
  // is less than half of the pause; behind a longer pass the period begins anew. `channels` are 18: CH1..CH16, 0..2047,
  // of which any above are sent as 2047, and CH17 and CH18, where any but 0 is sent as 1. True if it has sent. The
  // first frame is due at once.
  bool write(const uint16_t channels[], bool failsafe, bool lostFrame);

 private:
  HardwareSerial &_serial;
  uint32_t _last = 0;  // us, when the last frame was due
  uint16_t _period = 9000;
  bool _sent = false;
};
