/// @file
/// DecodeSBus: Futaba S.Bus from a serial port.
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
///     void loop() {
///       dSBus.parseSBusFrame();
///       dSBus.decodeSBusFrame(channels, failsafe, lostFrame);
///     }
///
/// DecodeSBus24 is the same for FrSky's 24 channels. Call all methods from setup(), loop() or serialEventN(). From an
/// interrupt: see extras/docs/interrupts.md.
template <typename Format>
class DecodeSBusOf {
 public:
  // ---- Open and close

  /// `port`: a hardware serial port, or any other Stream, which the sketch opens (listen()). It must outlive the
  /// object. Nothing is opened yet.
  template <typename Port>
  explicit DecodeSBusOf(Port &port) : _port(port) {}

  /// On pins of your choice, of an ESP32 or ESP8266: begin() opens `port` on `rx` and `tx`, and always on these. Other
  /// cores keep a port's pins, and say how they are chosen (extras/docs/boards.md); there this does not compile.
  template <typename Port>
  DecodeSBusOf(Port &port, int8_t rx, int8_t tx) : _port(port, rx, tx) {}

  /// Opens the port: 8E2, inverted if the port can do that (else the line needs an inverter), and 100000 baud unless
  /// told; Fast S.Bus is 200000. Forgets all frames and counters.
  ///
  /// An ESP32's or ESP8266's port is then on the constructor's pins, or on the core's, which belong to the flash of a
  /// classic ESP32 with core 1 or 2: extras/docs/boards.md.
  ///
  /// `config`: SERIAL_8E2 for an uninverted line, or another format of the core. What the port cannot do brings no
  /// frames, and nothing is reported: ask the example Diagnose. At less than 47060 baud nothing is opened. Any other
  /// Stream stays as it is: use listen().
  void begin(unsigned long baud = sbus::Baud, uint32_t config = sbus::PortConfig);

  /// For a port that the sketch has opened, such as a SoftwareSerial, which begin() cannot open. `baud` is the port's.
  /// Forgets all frames and counters.
  void listen(unsigned long baud = sbus::Baud);

  /// Closes a hardware serial port; after begin() only, or the Uno R4 crashes, and the nRF52 waits for ever. The last
  /// frame can still be decoded, until it is stale.
  void end();

  // ---- What every loop() calls

  /// Takes in the bytes that wait on the port; never waits itself. Call it in every loop(), at least every 5 ms (2.5 ms
  /// at 200000 baud), or frames are lost: 64 bytes of a core are full after 7.7 ms of a line without gaps.
  ///
  /// Call it also when nothing waits: only such calls tell for certain when the line was silent. A sketch that calls it
  /// only when bytes wait (serialEvent1(), an interrupt) loses a frame each time that its loop() is late by 2 ms.
  ///
  /// A frame is there at the first call after its last byte. The very first, the first with another kind of end byte,
  /// and one after discarded characters or 50 ms of silence may wait for what follows: the next frame, or 3 ms of
  /// silence.
  void parseSBusFrame();

  /// True while the newest frame is younger than the timeout; false before the first frame.
  bool SBusFrameOk();

  /// The newest frame: 18 values, CH1..CH16 as 0..2047, CH17 and CH18 as 0 or 1; of DecodeSBus24 24 values, CH1..CH24
  /// as 0..2047. Call it as often as you like.
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

  /// Returns the age of the newest frame in ms, 0..4294967; ULONG_MAX before the first. Never too young: it counts from
  /// the last call of parseSBusFrame() that did not find the frame's end yet. Call it at least once an hour.
  unsigned long frameAge();

  /// What has been seen on the line since begin(), by cause; all 0 before the first byte.
  sbus::Counters counters() const { return _finder.counters(); }

  // ---- Settings; begin() keeps them

  /// How long a frame stays good: 1..65535 ms, 100 unless told; 0: for ever, as in the paper.
  void setTimeout(uint16_t ms) { _link.setTimeout(ms); }

  /// How many lost frames in a row count as failsafe: 1..65535, 100 unless told; 0: no number does.
  void setLossLimit(uint16_t frames) { _link.setLossLimit(frames); }

 private:
  friend class DecodeSBus;  // for the further channels

  sbus::FrameFinderOf<Format> _finder;  // first: a Cortex-M0+ reaches its small members at once, 18 cycles a frame less
  sbus::Port _port;
  sbus::Link _link;
  uint32_t _decoded = 0;     // number of the frame that was decoded last
  uint32_t _staleExtra = 0;  // number of the frame with further channels that was found too old
};

/// Sixteen channels and two switches, as nearly all receivers send them; and what Futaba's FASSTest 26 adds.
class DecodeSBus : public DecodeSBusOf<sbus::Frame16> {
 public:
  /// As DecodeSBusOf().
  template <typename Port>
  explicit DecodeSBus(Port &port) : DecodeSBusOf(port) {}

  /// As DecodeSBusOf(), on pins of your choice.
  template <typename Port>
  DecodeSBus(Port &port, int8_t rx, int8_t tx) : DecodeSBusOf(port, rx, tx) {}

  /// The newest CH17..CH32, 16 values, 0..2047, of Futaba's FASSTest 26, which sends them in frames of their own. True
  /// if such a frame has come within the timeout; else `channels` is left alone. Flags and switches are those of
  /// decodeSBusFrame(). Call it once an hour at least.
  bool decodeExtraChannels(uint16_t channels[]);
};

/// The 24 channels of FrSky's ACCESS and TD receivers, if they are set to "SBUS 24". A line of 16 channels brings it no
/// frame: counters().otherSizeFrames counts then, as that of DecodeSBus does on a line of 24.
using DecodeSBus24 = DecodeSBusOf<sbus::Frame24>;
