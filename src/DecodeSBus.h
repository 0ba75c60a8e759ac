// DecodeSBus: Futaba S.Bus from a hardware serial port.
//
//   DecodeSBus dSBus(Serial1);
//   void setup() { dSBus.begin(); }
//   void serialEvent1() { dSBus.parseSBusFrame(); }
//   void loop() { dSBus.decodeSBusFrame(channels, failsafe, lostFrame); }
//
// After J. Lemaire, "Decoding the S-Bus protocol with a Grasshopper".
#pragma once

#include <Arduino.h>
#include <limits.h>

#include "SBusPort.h"
#include "sbus/FrameFinder.h"
#include "sbus/Link.h"

// One receiver on one serial port; several objects may live side by side on different ports. Call the methods from
// setup(), loop() or serialEventN(). What may be called from an interrupt stands at the end.
class DecodeSBus {
 public:
  // ---- Open and close

  // `serial` must outlive the object. Nothing is opened yet.
  explicit DecodeSBus(HardwareSerial &serial) : _serial(serial) {}

  // Opens the port: 100000 baud unless told (Fast S.Bus: 200000), SERIAL_SBUS (8E2, inverted). On a core that has no
  // SERIAL_SBUS it opens SERIAL_8E2, and the line then needs an inverter. Forgets all frames, and the counters.
  void begin(unsigned long baud = sbus::Baud);

  // begin() with another format: begin(100000, SERIAL_8E2) for a receiver's uninverted pad. The port does not tell if
  // it cannot do that: no frames come then.
  void begin(unsigned long baud, uint32_t config);

  // Closes the port. The last frame can still be decoded, until it is stale.
  void end();

  // ---- What every loop() calls

  // Takes in the bytes that wait on the port; never waits itself. Call it from serialEventN(), or from loop(), at least
  // every 5 ms (at 200000 baud 2.5 ms): the core's buffer of 64 bytes is full after 7.7 ms (3.8 ms) of a line without
  // pauses, and frames are lost then. A frame is there at the first call after its last byte came in; only the very
  // first, and the first with another kind of end byte, may wait for the next frame's first byte.
  void parseSBusFrame();

  // True while the newest frame is younger than the timeout; false before the first frame.
  bool SBusFrameOk();

  // The newest whole frame: 18 values, CH1..CH16 as 0..2047, CH17 and CH18 as 0 or 1.
  //   - lostFrame: this radio frame did not arrive, the channels are old ones; comes and goes in flight
  //   - failsafe: the receiver has given the link up, the channels are its failsafe setting; or it has reported lost
  //     frames for too long (setLossLimit)
  //
  // Before the first frame, and when the newest is older than the timeout, both are true and `channels` is left as it
  // is.
  void decodeSBusFrame(uint16_t channels[], bool &failsafe, bool &lostFrame);

  // True if a frame has come that decodeSBusFrame() has not handed out yet; false before the first frame, and when the
  // newest is older than the timeout.
  bool newFrame() { return _finder.counters().frames != _decoded && SBusFrameOk(); }

  // ---- The link

  // The one answer to "may I still trust these numbers?": NeverSeen, Ok, Lossy, Failsafe or Stale (sbus/Link.h).
  // NeverSeen before the first frame. Ask it, SBusFrameOk() or decodeSBusFrame() once an hour at least: micros() wraps.
  sbus::LinkState linkState();

  // Age of the newest frame in ms, never too young: a frame that waited while parseSBusFrame() was not called for 20 ms
  // is as old as that call. ULONG_MAX before the first frame. At most 4294967, 71 minutes; ask once an hour at least.
  unsigned long frameAge();

  // What has been seen on the line since begin(), by cause (sbus/Counters.h); all 0 before the first byte. Each is
  // right; together they may be one frame apart if parseSBusFrame() interrupts.
  sbus::Counters counters() const { return _finder.counters(); }

  // ---- Settings; begin() keeps them

  // How long a frame stays good: 1..65535 ms, 100 unless told; 0: for ever, as in the paper.
  void setTimeout(uint16_t ms) { _link.setTimeout(ms); }

  // How many lost frames in a row count as failsafe: 1..65535, 100 unless told; 0: any number is none.
  void setLossLimit(uint16_t frames) { _link.setLossLimit(frames); }

  // ---- Interrupts
  //
  // On the STM32L0 parseSBusFrame() may be called from Serial1.onReceive(), that is at PendSV level, while loop() calls
  // the others. Nobody then gets half of one frame and half of another, even if two frames complete while loop() reads,
  // and no interrupt is ever disabled. What breaks this: calling parseSBusFrame() from both contexts, calling begin(),
  // end() or a setter while frames come in, and a core that does not read 32 bits at once (AVR). Call onReceive()
  // before begin() or right after it: the port tells of new bytes only once until somebody reads them.

 private:
  HardwareSerial &_serial;
  sbus::FrameFinder _finder;
  sbus::Link _link;
  uint32_t _decoded = 0;  // number of the frame that was decoded last
};
