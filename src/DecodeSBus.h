/// @file
/// DecodeSBus: Futaba S.Bus from a hardware serial port.
///
/// After J. Lemaire, "Decoding the S-Bus protocol with a Grasshopper".
#pragma once

#include <Arduino.h>
#include <limits.h>

#include "SBusPort.h"
#include "sbus/FrameFinder.h"
#include "sbus/Link.h"

/// One receiver on one serial port; several objects may live side by side on different ports. Three calls do it:
///
///     DecodeSBus dSBus(Serial1);
///     void setup() { dSBus.begin(); }
///     void serialEvent1() { dSBus.parseSBusFrame(); }
///     void loop() { dSBus.decodeSBusFrame(channels, failsafe, lostFrame); }
///
/// Call all methods from setup(), loop() or serialEventN(). From an interrupt: see extras/docs/interrupts.md.
class DecodeSBus {
 public:
  // ---- Open and close

  /// `serial` must outlive the object. Nothing is opened yet.
  explicit DecodeSBus(HardwareSerial &serial) : _serial(serial) {}

  /// Opens the port with SERIAL_SBUS (8E2, inverted), 100000 baud unless told; Fast S.Bus is 200000. A core without
  /// SERIAL_SBUS opens SERIAL_8E2, and the line needs an inverter. Forgets all frames and counters.
  void begin(unsigned long baud = sbus::Baud);

  /// begin() with another format: begin(100000, SERIAL_8E2) for a receiver's uninverted pad. If the port cannot do it,
  /// no frames come; nothing is reported.
  void begin(unsigned long baud, uint32_t config);

  /// Closes the port. The last frame can still be decoded, until it is stale.
  void end();

  // ---- What every loop() calls

  /// Takes in the bytes that wait on the port; never waits itself. Call it at least every 5 ms (2.5 ms at 200000 baud),
  /// or frames are lost: the core's 64 bytes are full after 7.7 ms of a line without pauses.
  ///
  /// A frame is there at the first call after its last byte. The very first, and the first with another kind of end
  /// byte, may wait for the next frame's first byte.
  void parseSBusFrame();

  /// True while the newest frame is younger than the timeout; false before the first frame.
  bool SBusFrameOk();

  /// The newest frame: 18 values, CH1..CH16 as 0..2047, CH17 and CH18 as 0 or 1. Call it as often as you like.
  ///
  /// - lostFrame: this radio frame did not arrive, the channels are old ones; comes and goes in flight
  /// - failsafe: the receiver has given the link up, the channels are its failsafe setting; or it has reported lost
  ///   frames for too long (setLossLimit())
  ///
  /// Both are true, and `channels` is left alone, before the first frame and when the newest is as old as the timeout.
  void decodeSBusFrame(uint16_t channels[], bool &failsafe, bool &lostFrame);

  /// True if a frame has come that decodeSBusFrame() has not handed out yet. False before the first frame, and when the
  /// newest is as old as the timeout.
  bool newFrame() { return _finder.counters().frames != _decoded && SBusFrameOk(); }

  // ---- The link

  /// May these numbers be trusted? NeverSeen before the first frame, then Ok, Lossy, Failsafe or Stale. Call this,
  /// SBusFrameOk() or decodeSBusFrame() once an hour at least: micros() wraps after 71 minutes.
  sbus::LinkState linkState();

  /// Age of the newest frame in ms, 0..4294967; ULONG_MAX before the first. Never too young: a frame that waited
  /// because parseSBusFrame() was not called is as old as the call before. Call it once an hour at least.
  unsigned long frameAge();

  /// What has been seen on the line since begin(), by cause; all 0 before the first byte.
  sbus::Counters counters() const { return _finder.counters(); }

  // ---- Settings; begin() keeps them

  /// How long a frame stays good: 1..65535 ms, 100 unless told; 0: for ever, as in the paper.
  void setTimeout(uint16_t ms) { _link.setTimeout(ms); }

  /// How many lost frames in a row count as failsafe: 1..65535, 100 unless told; 0: no number does.
  void setLossLimit(uint16_t frames) { _link.setLossLimit(frames); }

 private:
  HardwareSerial &_serial;
  sbus::FrameFinder _finder;
  sbus::Link _link;
  uint32_t _decoded = 0;  // number of the frame that was decoded last
};
