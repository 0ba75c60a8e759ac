/// @file
/// Decodes Futaba S.Bus from a serial port. The class and its methods follow J. Lemaire, "Decoding the S-Bus protocol
/// with a Grasshopper".
#pragma once

#include <Arduino.h>
#include <limits.h>

#include "SBusPort.h"
#include "port/Clock.h"
#include "port/Listener.h"
#include "sbus/Barrier.h"
#include "sbus/ExtraFrame.h"
#include "sbus/FrameFinder.h"
#include "sbus/FrameValue.h"
#include "sbus/Link.h"

namespace sbus {

class LinkQuality;
class Ticker;

/// @cond  Not for sketches.

// A link, and the clock that its ages come from. (A base class without members takes no byte.)
struct ClockedLink : Link, Clock {};

/// @endcond

}  // namespace sbus

/// Decodes one receiver on one serial port. Several objects can work on different ports, but only one on each port: two
/// would take bytes from each other, and on a Grasshopper only the last that called begin() receives. Name none of them
/// `sbus`, which is a namespace. A sketch needs two calls:
///
///     DecodeSBus dSBus(Serial1);
///     SBusFrame frame;
///     void setup() { dSBus.begin(); }
///     void loop() {
///       dSBus.read(frame);
///       const uint16_t throttle = frame.failsafe ? 172 : frame.channels[2];
///     }
///
/// The paper's sketch calls parseSBusFrame() and decodeSBusFrame() instead.
///
/// DecodeSBus24 decodes FrSky's 24 channels, DecodeSBus32 also Futaba's CH17..CH32. Call all methods from setup(),
/// loop() or serialEventN(). (A Grasshopper's core does not call serialEventN(), because no bytes wait there.)
///
/// On a Grasshopper (STM32L0) the port calls the object when bytes come, above loop(): the sketch need not call a
/// method in time, but the object must live until end(). DecodeSBusBackground does the same on other boards:
/// extras/docs/interrupts.md.
template <typename Format, typename Events = sbus::NoEvents>
class DecodeSBusOf {
 public:
  using ChannelArray = sbus::ChannelArray<uint16_t, Format::Channels>;  ///< an array or a pointer: 18 or 24 values
  using Frame = sbus::FrameValue<Format::Channels>;                     ///< an SBusFrame, or an SBusFrame24

  // ---- Open and close

  /// Remembers `port`, and opens nothing yet. A hardware serial port is opened by begin(); any other Stream is opened
  /// by the sketch (see listen()). `port` must outlive the object.
  template <typename Port>
  explicit DecodeSBusOf(Port &port) : _port(port) {}

  /// Remembers `port` and its pins, on an ESP32 or ESP8266: begin() always opens it on `rx` and `tx`. On other cores
  /// this constructor does not compile; extras/docs/boards.md says how they choose pins.
  template <typename Port>
  DecodeSBusOf(Port &port, int8_t rx, int8_t tx) : _port(port, rx, tx) {}

  /// Opens the port as 8E2, inverted if the port can invert (otherwise the line needs an inverter), and forgets all
  /// frames and counters. Default: 100000 baud. Fast S.Bus: 200000 baud.
  ///
  /// `config` is SERIAL_8E2 for an uninverted line, or another format of the core. If the port does not support a
  /// setting, begin() does not report it, and no frames come: the example Diagnose finds the cause. Below 47060 baud
  /// begin() opens nothing. It does not open a Stream other than a hardware serial port: use listen().
  ///
  /// On a Grasshopper begin() and listen() replace the sketch's own `Serial1.onReceive()`, and end() removes it.
  ///
  /// Without pins in the constructor an ESP32 or ESP8266 uses the core's pins. With core 1 or 2, Serial1's pins on a
  /// classic ESP32 belong to its flash (extras/docs/boards.md).
  void begin(unsigned long baud = sbus::Baud, uint32_t config = sbus::PortConfig);

  /// Starts on a port that the sketch has opened with `baud`, such as a SoftwareSerial, and forgets all frames and
  /// counters.
  void listen(unsigned long baud = sbus::Baud);

  /// Closes a hardware serial port. Call it only after begin(): otherwise the Uno R4 crashes, and the nRF52 waits
  /// forever. The last frame can be decoded until it is stale.
  void end();

  // ---- Called in every loop()

  /// Reads the waiting bytes, like parseSBusFrame(), and writes the newest frame to `frame`, like decodeSBusFrame(): an
  /// SBusFrame, or an SBusFrame24 for DecodeSBus24. Returns true if the frame is new. Flags and age are right after
  /// each call, even if no frame comes: check frame.failsafe whatever it returns. Call it as often as parseSBusFrame().
  bool read(Frame &frame);

  /// Reads the bytes that wait on the port, and never waits for more. Call it in every loop(), at least every 5 ms (2.5
  /// ms at 200000 baud): on a line without gaps, a core's buffer of 64 bytes is full after 7.7 ms, and then loses
  /// bytes. On a Grasshopper the sketch need not call it, unless it has set the port's onReceive() itself.
  ///
  /// Call it also when nothing waits: only an empty call proves that the line was silent. A sketch that calls it only
  /// when bytes wait (serialEvent1()) loses a frame each time its loop() is late by 2 ms.
  ///
  /// While interrupts are off, bytes get lost, and parts of two frames may be joined, above all on an AVR
  /// (extras/docs/boards.md).
  ///
  /// A frame is complete at the first call after its last byte. The very first frame, the first frame of another line
  /// variant, and a frame after discarded bytes or 50 ms of silence may have to wait for the next frame, or for 3 ms of
  /// silence.
  void parseSBusFrame();

  /// Returns true while the newest frame is younger than the timeout; false before the first frame.
  bool SBusFrameOk();

  /// Writes the newest frame to `channels`: 18 values, CH1..CH16 as 0..2047, CH17 and CH18 as 0 or 1. DecodeSBus24
  /// writes 24 values, CH1..CH24 as 0..2047. It may be called at any rate.
  ///
  /// - lostFrame: this radio frame did not arrive, and the channels repeat old values. It comes and goes in flight.
  /// - failsafe: the receiver is in failsafe, and the channels are its failsafe setting; or it has reported lost frames
  ///   for too long (setLossLimit()).
  ///
  /// Before the first frame, and once the newest is as old as the timeout, both are true and `channels` is unchanged.
  void decodeSBusFrame(ChannelArray channels, bool &failsafe, bool &lostFrame);

  /// Returns true if decodeSBusFrame() and read() have not yet handed out the newest frame; false before the first
  /// frame, and once the newest is as old as the timeout.
  bool newFrame() {
    if (_port.callsBack()) {  // a sketch may wait for it, and call nothing else
      const bool isOk = SBusFrameOk();
      sbus::barrier();
      return isOk && _finder.counters().frames != _decoded;
    }
    return _finder.counters().frames != _decoded && SBusFrameOk();
  }

  // ---- The link

  /// Returns how far the channels can be trusted: NeverSeen before the first frame, then Ok, Lossy, Failsafe or Stale.
  /// Call this, SBusFrameOk() or decodeSBusFrame() at least once an hour, because micros() wraps after 71 minutes. If
  /// the board sleeps, its clocks may stop: then call begin() when it wakes (extras/docs/boards.md, "A board that
  /// sleeps").
  sbus::LinkState linkState();

  /// Returns the age of the newest frame in ms, 0..4294967; ULONG_MAX before the first. The age is never
  /// underestimated while the board is awake: it counts from the last poll before the frame's end. It includes the
  /// board's sleep, by millis(), on a Grasshopper; on other boards see linkState(). Call it at least once an hour.
  unsigned long frameAge();

  /// Returns the counters since begin(), all taken at one moment. All are 0 before the first byte.
  sbus::Counters counters() const {
    for (;;) {
      const uint8_t polls = _port.polls();
      sbus::barrier();
      const sbus::Counters counters = _finder.counters();
      sbus::barrier();
      if (polls == _port.polls()) {
        return counters;
      }
    }
  }

  // ---- Settings; begin() keeps them

  /// Sets how long a frame stays valid, 1..65535 ms. Default: 100 ms. 0 disables the timeout, as in the paper.
  void setTimeout(uint16_t ms) { _link.setTimeout(ms); }

  /// Sets how many lost frames in a row count as failsafe, 1..65535. Default: 100. 0 disables it.
  void setLossLimit(uint16_t frames) { _link.setLossLimit(frames); }

 protected:
  /// @cond  For the classes of this library.

  sbus::LinkState state(uint32_t &age);
  bool newest(Frame &frame);
  void decode(sbus::LinkState state, ChannelArray channels, bool &failsafe, bool &lostFrame);
  void start(unsigned long baud);
  void reset(unsigned long baud);
  template <typename Object>
  void hear(void (Object::*method)(), Object *object);
  void arrived();
  void take(bool isPrompt);
  void poll(bool isPrompt);
  void judge(const uint8_t *frame);
  int read(int waiting);

  // First: a Cortex-M0+ reaches its small members at once, 18 cycles a frame less.
  sbus::FrameFinderOf<Format, Events> _finder;
  sbus::ListeningPort _port;
  sbus::ClockedLink _link;
  uint32_t _decoded = 0;  // number of the frame that was decoded last

  /// @endcond

 private:
  friend class sbus::LinkQuality;  // for the clock
  friend class sbus::Ticker;       // for the port

  static uint32_t clock() { return sbus::Clock::now(); }
};

/// Decodes sixteen channels and two switches, which nearly all receivers send. On a line of Futaba's FASSTest 26 it
/// discards the frames with CH17..CH32: use DecodeSBus32.
using DecodeSBus = DecodeSBusOf<sbus::Frame16>;

/// Decodes like DecodeSBus, and also the extra channels of Futaba's FASSTest 26, CH17..CH32.
class DecodeSBus32 : public DecodeSBusOf<sbus::Frame16Extra, sbus::ExtraFrame> {
 public:
  using DecodeSBusOf::DecodeSBusOf;  ///< see DecodeSBusOf()

  /// Writes the newest CH17..CH32 to `channels`, 16 values, 0..2047: they come in separate frames. Returns true if such
  /// a frame came within the timeout; otherwise `channels` is unchanged. The flags and switches are those of
  /// decodeSBusFrame(). Call it at least once an hour.
  bool decodeExtraChannels(sbus::ChannelArray<uint16_t, sbus::ProportionalCount> channels);
};

/// Decodes the 24 channels of FrSky's ACCESS and TD receivers that are set to "SBUS 24". On a line of 16 channels it
/// delivers no frame, and counters().otherSizeFrames grows; likewise for a DecodeSBus on a line of 24 channels.
using DecodeSBus24 = DecodeSBusOf<sbus::Frame24>;

/// Decodes sixteen channels and two switches, and treats a frame with 0 on CH1 to CH4 as lost: it counts in
/// counters().lostFrames, and the sketch's array keeps its values, so the array must outlive loop(). Failsafe is true
/// until a frame comes that is not lost. A FrSky receiver that is set to "No pulses" may send these frames, and does
/// not always set a flag in them.
using DecodeSBusNoPulses = DecodeSBusOf<sbus::Frame16NoPulses>;
