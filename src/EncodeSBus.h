/// @file
/// EncodeSBus: sends Futaba S.Bus through a hardware serial port; the mirror of DecodeSBus.
#pragma once

#include <Arduino.h>

#include "SBusPort.h"
#include "sbus/Frame.h"

/// One sender on one serial port. Two calls do it:
///
///     EncodeSBus sBus(Serial2);
///     void setup() { sBus.begin(); }
///     void loop() { sBus.write(channels, failsafe, lostFrame); }
///
/// EncodeSBus24 is the same for FrSky's 24 channels. A DecodeSBus may listen on the same port: begin() and end() that
/// one, not this. A port that the sketch has opened needs no begin(). Call all methods from setup(), loop() or
/// serialEventN(), none from an interrupt.
template <typename Format>
class EncodeSBusOf {
 public:
  /// `port`: a hardware serial port, or any other Stream, which the sketch opens. It must outlive the object. Nothing
  /// is opened yet.
  template <typename Port>
  explicit EncodeSBusOf(Port &port) : _port(port) {}

  /// On pins of your choice, as DecodeSBusOf().
  template <typename Port>
  EncodeSBusOf(Port &port, int8_t rx, int8_t tx) : _port(port, rx, tx) {}

  /// Opens the port as DecodeSBus::begin() does. Nothing is sent before write().
  void begin(unsigned long baud = sbus::Baud, uint32_t config = sbus::PortConfig);

  /// Closes a hardware serial port; after begin() only, as DecodeSBus::end(). The known cores first send what they
  /// still hold, and wait for it: up to 8 ms. Do not call write() after it: some ports do not know that they are closed
  /// (AVR).
  void end();

  /// Time from one frame to the next: 0..65535 us, 9000 unless told. A frame takes 3000 us (1500 at 200000 baud), one
  /// of 24 channels 4320, and receivers need a pause after it, so set no less than 4000 (2000), or 6000.
  void setPeriod(uint16_t us) { _period = us; }

  /// Sends a frame if it is time for one and the port takes all of it, never a part. Call it in every loop(), after
  /// begin(). True if it has sent; the first frame is sent at once.
  ///
  /// It waits for nothing if the port has room for 25 bytes. A port that never has, or cannot say, is given the frame
  /// as soon as it has as much room as ever, and the core waits until it has taken all: up to 3 ms (Uno R4,
  /// mbed).
  ///
  /// `channels` are 18: CH1..CH16, clamped to 2047, then CH17 and CH18, where any but 0 is sent as 1. EncodeSBus24 has
  /// 24, CH1..CH24, clamped to 2047. The period stays exact while a loop period is less than half of the pause; after a
  /// longer one it begins anew.
  bool write(const uint16_t channels[], bool failsafe, bool lostFrame);

 private:
  sbus::Port _port;
  uint32_t _last = 0;  // us, when it was time for the last frame
  uint16_t _period = 9000;
  uint8_t _room = 0;  // bytes: the most that the port has said it takes, up to a frame
  bool _sent = false;
};

/// Sixteen channels and two switches.
using EncodeSBus = EncodeSBusOf<sbus::Frame16>;
/// FrSky's 24 channels.
using EncodeSBus24 = EncodeSBusOf<sbus::Frame24>;
