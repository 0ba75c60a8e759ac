// DecodeSBus: Futaba S.Bus from a hardware serial port.
//
//   DecodeSBus dSBus(Serial1);
//   void serialEvent1() { dSBus.parseSBusFrame(); }
//
// After J. Lemaire, "Decoding the S-Bus protocol with a Grasshopper".
#pragma once

#include <Arduino.h>

#include "sbus/Receiver.h"

// One receiver on one serial port; several objects may live side by side on different ports. All methods are to be
// called from the sketch's setup(), loop() or serialEventN(), none of them from an interrupt.
class DecodeSBus {
 public:
  // `serial` must outlive the object. Nothing is opened yet.
  explicit DecodeSBus(HardwareSerial &serial) : _serial(serial) {}

  // Opens the port: 100000 baud, SERIAL_SBUS (8E2, inverted). On a core that has no SERIAL_SBUS it opens SERIAL_8E2, and
  // the line then needs an inverter. Forgets all frames seen so far.
  void begin();

  // Closes the port. The last frame can still be decoded.
  void end();

  // True as soon as one whole frame has been received since begin().
  bool SBusFrameOk() const;

  // Takes in the bytes that wait on the port; never waits itself. Call it from serialEventN(), or from loop(), at least
  // every 5 ms: the core's buffer of 64 bytes takes 7.7 ms of a line without pauses. After a longer wait the frames that
  // did not fit are lost, and nothing else.
  void parseSBusFrame();

  // The last whole frame: 18 values, CH1..CH16 as 0..2047, CH17 and CH18 as 0 or 1.
  //   lostFrame  this radio frame did not arrive, the channels are old ones; comes and goes in flight
  //   failsafe   the receiver has given the link up, the channels are its failsafe setting
  // Before the first frame `channels` is left as it is, and failsafe and lostFrame are both true.
  void decodeSBusFrame(uint16_t channels[], bool &failsafe, bool &lostFrame) const;

 private:
  HardwareSerial &_serial;
  sbus::Receiver _receiver;
};
