/// @file
/// Decodes S.Bus while loop() does other things.
#pragma once

#include "DecodeSBus.h"

#if !defined(SERIAL_SBUS)
#include "port/Held.h"
#include "port/Ticker.h"
#if !defined(SBUS_TICKER)
#error "DecodeSBusBackground knows no timer of this core. Poll a DecodeSBus in loop(): extras/docs/interrupts.md"
#elif defined(SBUS_SENSOR)
#error "DecodeSBusBackground would delay the answers of an SBus2Sensor: extras/docs/interrupts.md"
#endif
#define SBUS_BACKGROUND
#endif

#if !defined(SBUS_TICKER)

/// A Grasshopper's port calls back by itself: there this is `Decoder`.
template <typename Decoder>
using DecodeSBusBackgroundOf = Decoder;

#else

/// Decodes like `Decoder`, while loop() does other things: it reads the port each millisecond, in an interrupt or, on
/// an ESP32, in a task. On a Grasshopper this is `Decoder` itself, which already listens in the background.
///
///     DecodeSBusBackground dSBus(Serial1);
///     void setup() { dSBus.begin(); }
///     void loop() {
///       delay(500);
///       dSBus.decodeSBusFrame(channels, failsafe, lostFrame);
///     }
///
/// Call all methods from setup() and loop(), at any moment. Several objects can work on different ports, and each must
/// live until end(). extras/docs/interrupts.md lists the boards; on others this header does not compile.
///
/// A function that takes a DecodeSBus does not take it, because that function would open the port without the timer.
/// Make such a function a template: `template <typename Decoder> void open(Decoder &dSBus) { dSBus.begin(); }`.
///
/// `Decoder` is DecodeSBus, DecodeSBus24, DecodeSBus32, DecodeSBusNoPulses or DecodeSBusTelemetry.
template <typename Decoder>
class DecodeSBusBackgroundOf : public sbus::HeldOf<Decoder, sbus::Ticked> {
  using Held = sbus::HeldOf<Decoder, sbus::Ticked>;

 public:
  /// See DecodeSBusOf(). `port` must be a hardware serial port of the core, on a Pico Serial1 or Serial2.
  template <typename Port>
  explicit DecodeSBusBackgroundOf(Port &port) : Held(port) {
    check<Port>();
  }

  /// See DecodeSBusOf(), with pins.
  template <typename Port>
  DecodeSBusBackgroundOf(Port &port, int8_t rx, int8_t tx) : Held(port, rx, tx) {
    check<Port>();
  }

  /// Opens the port, like DecodeSBusOf::begin(), and listens from then on. If a Teensy's IntervalTimers or a Pico's
  /// alarms are all taken, or another decoder listens on a Pico's other core, nothing listens: then call
  /// parseSBusFrame() in loop(), as for a DecodeSBus.
  void begin(unsigned long baud = sbus::Baud, uint32_t config = sbus::PortConfig) {
    this->stopTicks();
    Decoder::begin(baud, config);
    this->startTicks(poll);
  }

  /// Starts on a port that the sketch has opened, like DecodeSBusOf::listen(), and listens as after begin().
  void listen(unsigned long baud = sbus::Baud) {
    this->stopTicks();
    Decoder::listen(baud);
    this->startTicks(poll);
  }

  /// Stops listening, and closes the port, like DecodeSBusOf::end().
  void end() {
    this->stopTicks();
    Decoder::end();
  }

  /// See DecodeSBusOf.
  bool read(typename Decoder::Frame &frame) {
    const sbus::Ticked::Hold hold(*this);
    return Decoder::read(frame);
  }

  /// Reads the waiting bytes, like DecodeSBusOf::parseSBusFrame(). Call it at any rate, or never.
  void parseSBusFrame() {
    const sbus::Ticked::Hold hold(*this);
    Decoder::parseSBusFrame();
  }

 private:
  template <typename Port>
  static void check() {
    static_assert(sbus::Ticker::canPoll(static_cast<Port *>(nullptr)),
                  "An interrupt cannot read this port. Use DecodeSBus: extras/docs/interrupts.md");
  }

  static bool poll(sbus::Ticked &ticked) {
    return sbus::Ticker::poll<Decoder>(static_cast<DecodeSBusBackgroundOf &>(ticked));
  }
};

#endif

/// Decodes like DecodeSBus, while loop() does other things.
using DecodeSBusBackground = DecodeSBusBackgroundOf<DecodeSBus>;
