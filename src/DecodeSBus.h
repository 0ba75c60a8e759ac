/// @file
/// Decodes Futaba S.Bus from a serial port. The class and its methods follow J. Lemaire, "Decoding the S-Bus protocol
/// with a Grasshopper".
#pragma once

#include <Arduino.h>
#include <limits.h>

#include "port/Clock.h"
#include "port/CallbackPort.h"
#include "port/PortReader.h"
#include "sbus/Barrier.h"
#include "sbus/FrameFinder.h"

namespace sbus {

class LinkQuality;

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
/// loop() or serialEventN(). (A Grasshopper's core does not call serialEventN(), because no bytes are pending there.)
///
/// On a Grasshopper (STM32L0) the serial driver calls the decoder back at interrupt level whenever bytes arrive: the
/// sketch need not call a method in time, but the object must live until end(). DecodeSBusBackground does the same on
/// other boards: extras/docs/interrupts.md.
template <typename Format, typename Events = sbus::NoEvents, typename Polling = sbus::PolledByLoop>
class DecodeSBusOf : protected Polling,
                     protected sbus::PortReader<Format, Events, sbus::CallbackPort, sbus::ClockedLink> {
  using Reader = sbus::PortReader<Format, Events, sbus::CallbackPort, sbus::ClockedLink>;

 public:
  template <typename Other>
  using PolledBy = DecodeSBusOf<Format, Events, Other>;  ///< the same, polled in another way: DecodeSBusBackgroundOf
  using ChannelArray = sbus::ChannelArray<uint16_t, Format::Channels>;  ///< an array or a pointer: 18 or 24 values
  using Frame = typename Format::Value;                                 ///< SBusFrame, or SBusFrame24

  // ---- Open and close

  /// Remembers `port`, and opens nothing yet. A hardware serial port is opened by begin(); any other Stream is opened
  /// by the sketch (see listen()). `port` must outlive the object.
  template <typename Port>
  explicit DecodeSBusOf(Port &port) : Reader(port) {
    Polling::template check<Port>();
  }

  /// Does not compile: `DecodeSBus dSBus(&Serial1)` is another library's form.
  template <typename Port>
  explicit DecodeSBusOf(Port *port) : Reader(*port) {
    static_assert(sizeof(Port) == 0, "Write DecodeSBus dSBus(Serial1), without the &");
  }

  /// Remembers `port` and its pins, on an ESP32 or ESP8266: begin() always opens it on `rx` and `tx`. On other cores
  /// this constructor does not compile; extras/docs/boards.md says how they choose pins.
  template <typename Port>
  DecodeSBusOf(Port &port, int8_t rx, int8_t tx) : Reader(port, rx, tx) {
    Polling::template check<Port>();
  }

  /// Opens the port as 8E2, inverted if the port can invert (otherwise the line needs an inverter), and forgets all
  /// frames and counters. Default: 100000 baud. Fast S.Bus: 200000 baud.
  ///
  /// `config` is sbus::Uninverted, the core's SERIAL_8E2, for an uninverted line, or another format of the core. If the
  /// port does not support a setting, begin() does not report it, and no frames come: the example Diagnose finds the
  /// cause. Below 47060 baud begin() opens nothing. It does not open a Stream other than a hardware serial port: use
  /// listen().
  ///
  /// On a Grasshopper begin() and listen() replace the sketch's own `Serial1.onReceive()`, and end() removes it.
  ///
  /// Without pins in the constructor an ESP32 or ESP8266 uses the core's pins. With core 1 or 2, Serial1's pins on a
  /// classic ESP32 belong to its flash (extras/docs/boards.md).
  void begin(unsigned long baud = sbus::Baud, uint32_t config = sbus::Inverted) {
    this->stopPolling();
    _port.hold();
    open(baud, config);
    start(baud);
  }

  /// Starts on a port that the sketch has opened with `baud`, such as a SoftwareSerial, and forgets all frames and
  /// counters. Pending bytes count as new: if they may be old, read them first.
  void listen(unsigned long baud = sbus::Baud) {
    this->stopPolling();
    _port.hold();
    start(baud);
  }

  /// Closes a hardware serial port. Call it only after begin(): otherwise the Uno R4 crashes, and the nRF52 waits
  /// forever. The last frame can be decoded until it is stale.
  void end() {
    this->stopPolling();
    _port.hold();
    _port.close();
    _port.stop();
    _link.stop();
  }

  // ---- Called in every loop()

  /// Reads the waiting bytes, like parseSBusFrame(), and writes the newest frame to `frame`, like decodeSBusFrame(): an
  /// SBusFrame, or an SBusFrame24 for DecodeSBus24. Returns true if the frame is new. Flags and age are right after
  /// each call, even if no frame comes: check frame.failsafe whatever it returns. Call it as often as parseSBusFrame().
  bool read(Frame &frame) {
    const Lock lock(*this);
    pollAll(false);
    return writeTo(frame);
  }

  /// Reads the port's pending bytes, and never waits for more. Call it in every loop(), at least every 5 ms (2.5
  /// ms at 200000 baud): on a line without gaps, a core's buffer of 64 bytes is full after 7.7 ms, and then loses
  /// bytes. On a Grasshopper the sketch need not call it, unless it has set the port's onReceive() itself.
  ///
  /// Call it even when no bytes are pending: only a call that finds nothing proves that the line was idle. A sketch
  /// that calls it only when bytes are pending (serialEvent1()) loses a frame each time its loop() is late by 2 ms.
  ///
  /// While interrupts are off, bytes get lost, and parts of two frames may be joined, above all on an AVR
  /// (extras/docs/libraries.md).
  ///
  /// A frame is delivered by the first call after its last byte. The very first frame, the first frame of another line
  /// variant, and a frame after discarded bytes or 50 ms of silence may be held until the next frame, or 3 ms of
  /// silence.
  void parseSBusFrame() {
    const Lock lock(*this);
    pollAll(false);
  }

  /// Returns true while the newest frame is younger than the timeout; false before the first frame.
  bool SBusFrameOk() {
    const Lock lock(*this);
    return isOk();
  }

  /// Writes the newest frame to `channels`: 18 values, CH1..CH16 as 0..2047, CH17 and CH18 as 0 or 1. DecodeSBus24
  /// writes 24 values, CH1..CH24 as 0..2047. It may be called at any rate.
  ///
  /// - lostFrame: this radio frame did not arrive, and the channels repeat old values. It comes and goes in flight.
  /// - failsafe: the receiver is in failsafe, and the channels are its failsafe setting; or it has reported lost frames
  ///   for too long (setLossLimit()).
  ///
  /// Before the first frame, and once the newest is as old as the timeout, both are true and `channels` is unchanged.
  void decodeSBusFrame(ChannelArray channels, bool &failsafe, bool &lostFrame) {
    const Lock lock(*this);
    decode(state(), channels, failsafe, lostFrame);
  }

  /// Returns true if decodeSBusFrame() and read() have not yet handed out the newest frame; false before the first
  /// frame, and once the newest is as old as the timeout.
  bool newFrame() {
    const Lock lock(*this);
    if (_port.callsBack()) {  // a sketch may wait for it, and call nothing else
      const bool wasOk = isOk();
      sbus::barrier();
      return wasOk && _finder.counters().frames != _decoded;
    }
    return _finder.counters().frames != _decoded && isOk();
  }

  // ---- The link

  /// Returns how far the channels can be trusted: NeverSeen before the first frame, then Ok, Lossy, Failsafe or Stale.
  ///
  /// Call this, SBusFrameOk() or decodeSBusFrame() at least once an hour, because micros() wraps after 71 minutes.
  /// If the board sleeps, its clocks may stop: then call begin() when it wakes (extras/docs/sleep.md).
  sbus::LinkState linkState() {
    const Lock lock(*this);
    return state();
  }

  /// Returns the age of the newest frame in ms, 0..4294967; ULONG_MAX before the first. The age is never
  /// underestimated while the board is awake: it counts from the last poll before the frame's end. It includes the
  /// board's sleep, by millis(), on a Grasshopper; on other boards see linkState(). Call it at least once an hour.
  unsigned long frameAge() {
    const Lock lock(*this);
    return ageInMs();
  }

  /// Returns the counters since begin(), all taken at one moment. All are 0 before the first byte.
  sbus::Counters counters() const {
    const Lock lock(*this);
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

  /// Sets how long a frame stays valid, 1..65535 ms; more counts as 65535. Default: 100 ms. 0 disables the timeout, as
  /// in the paper.
  void setTimeout(unsigned long ms) { _link.setTimeout(ms); }

  /// Sets how many lost frames in a row count as failsafe, 1..65535. Default: 100. 0 disables it.
  void setLossLimit(uint16_t frames) {
    const Lock lock(*this);  // an AVR writes its two bytes one by one
    _link.setLossLimit(frames);
  }

 protected:
  /// @cond  For the classes of this library.

  // Keeps other contexts from polling. Public methods that touch what a poll writes take one; begin(), listen() and
  // end() stop the polling instead. The methods below assume one.
  using Lock = typename Polling::Lock;

  using Reader::_finder;
  using Reader::_link;
  using Reader::_port;
  using Reader::pollAll;

  bool isOk() { return sbus::isYoung(state()); }

  unsigned long ageInMs() {
    uint32_t age;
    const sbus::LinkState now = state(age);
    return inMs(now, age);
  }

  static unsigned long inMs(sbus::LinkState state, uint32_t age) {
    return state == sbus::LinkState::NeverSeen ? ULONG_MAX : age / 1000;
  }

  sbus::LinkState state() {
    uint32_t age;
    return state(age);
  }

  // Returns the state of the link, and the age of the newest frame, us. Retries if a frame comes in between.
  sbus::LinkState state(uint32_t &age) {
    for (;;) {
      const uint32_t time = _finder.frameTime();
      sbus::barrier();
      age = _link.age(_link.ageOf(time));
      const sbus::LinkState state = _link.state(age);
      sbus::barrier();
      if (!sbus::CallbackPort::HasCallback || time == _finder.frameTime()) {
        constexpr uint32_t Old = 100000;  // us
        if (_port.callsBack() && (state == sbus::LinkState::NeverSeen || age >= Old)) {
          pollAll(false);  // if the port's call was lost, the next one comes only after a poll
        }
        return state;
      }
    }
  }

  // Reads the age first: a frame that comes in between is younger.
  bool writeTo(Frame &frame) {
    const uint32_t before = _decoded;
    uint32_t age;
    const sbus::LinkState now = state(age);
    frame.age = inMs(now, age);
    decode(now, frame.channels, frame.failsafe, frame.lostFrame);
    return _decoded != before;
  }

  void decode(sbus::LinkState state, ChannelArray channels, bool &failsafe, bool &lostFrame) {
    if (!sbus::isYoung(state) || channels == nullptr) {
      failsafe = true;
      lostFrame = true;
      return;
    }
    // If a frame is completed meanwhile, the next one may overwrite the one that is being read: then read the new one.
    uint32_t number;
    do {
      number = _finder.counters().frames;
      sbus::barrier();
      const uint8_t *const frame = _finder.newest();
      Format::unpack(frame, channels);
      lostFrame = (Format::flags(frame) & sbus::FlagLostFrame) != 0;
      failsafe =
          _link.isFailsafe() || (Format::ZeroMeansLost && sbus::hasNoPulses(channels));  // the array has kept none
      sbus::barrier();
    } while (sbus::CallbackPort::HasCallback && number != _finder.counters().frames);
    _decoded = number;
  }

  // Opens the port, and discards bytes that an AVR's port still holds: nobody knows how old they are. (The STM32L0's
  // begin() has emptied its own: stm32l0_uart.c:846.)
  void open(unsigned long baud, uint32_t config) {
    _port.open(baud, config);
    const bool mayHold = !sbus::CallbackPort::HasCallback && baud > sbus::SlowestBaud;
    for (int waiting = mayHold ? _port.available() : 0; waiting > 0; waiting--) {
      _port.stream().read();
    }
  }

  void start(unsigned long baud) {
    reset(baud);
    startCallbacks<Reader>(&Reader::onReceive, this);
    this->startPolling(*this);
  }

  void reset(unsigned long baud) {
    Reader::reset(baud);
    _decoded = 0;
  }

  // Lets the port call `method`. The first poll comes at once: a port with pending bytes does not call before that.
  template <typename Object>
  void startCallbacks(void (Object::*method)(), Object *object) {
    const bool callsBack = _port.start(method, object);
    _port.unlock();
    if (callsBack) {
      pollAll(false);
    }
  }

  uint32_t _decoded = 0;  // number of the frame that was decoded last

  /// @endcond

 private:
  friend class sbus::LinkQuality;  // for clock()
  friend Polling;                  // for pollAll() and _port

  static uint32_t clock() { return sbus::Clock::now(); }
};

/// Decodes sixteen channels and two switches, which nearly all receivers send. On a line of Futaba's FASSTest 26 it
/// discards the frames with CH17..CH32: use DecodeSBus32 (DecodeSBus32.h).
using DecodeSBus = DecodeSBusOf<sbus::Frame16>;

/// Decodes the 24 channels of FrSky's ACCESS and TD receivers that are set to "SBUS 24". On a line of 16 channels it
/// delivers no frame, and counters().otherSizeFrames grows; likewise for a DecodeSBus on a line of 24 channels.
using DecodeSBus24 = DecodeSBusOf<sbus::Frame24>;

/// Decodes sixteen channels and two switches, and treats a frame with 0 on CH1 to CH4 as lost: it counts in
/// counters().lostFrames, and the sketch's array keeps its values, so the array must outlive loop(). Failsafe is true
/// until a frame comes that is not lost, and while CH1 to CH4 of the sketch's array are 0. A FrSky receiver that is set
/// to "No pulses" may send these frames, and does not always set a flag in them.
using DecodeSBusNoPulses = DecodeSBusOf<sbus::Frame16NoPulses>;

namespace sbus {

/// Returns true if begin() opens this port inverted; otherwise the line needs an inverter, or the sketch that opens the
/// port inverts it. extras/docs/boards.md lists the result for each board.
template <typename Port>
constexpr bool inverts(Port &) {
  return KindOf<Port>::Inverts;
}

/// Returns true if begin() can open this port inverted and uninverted, any number of times: on an ESP32 or ESP8266 on
/// the pins given to DecodeSBus's constructor, or on the core's.
template <typename Port>
constexpr bool opensBothWays(Port &) {
  return KindOf<Port>::BothWays;
}

}  // namespace sbus
