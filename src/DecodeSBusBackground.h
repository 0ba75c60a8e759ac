/// @file
/// Decodes S.Bus while loop() does other things.
#pragma once

#include "DecodeSBus.h"

#if !defined(SBUS_STM32L0)
#include "port/timer/PolledByTimer.h"
#if !defined(SBUS_POLLING_TIMER)
#error "DecodeSBusBackground knows no timer of this core. Poll a DecodeSBus in loop(): extras/docs/interrupts.md"
#elif defined(SBUS_SENSOR)
#error "DecodeSBusBackground would delay the answers of an SBus2Sensor: extras/docs/interrupts.md"
#endif
#define SBUS_BACKGROUND
#endif

#if !defined(SBUS_POLLING_TIMER)

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
/// `port` must be a hardware serial port of the core, on a Pico Serial1 or Serial2. Call all methods from setup() and
/// loop(), at any moment; none need be called in time. Several objects can work on different ports, and each must live
/// until end(). extras/docs/interrupts.md lists the boards; on others this header does not compile.
///
/// If a Teensy's IntervalTimers or a Pico's alarms are all taken, or another decoder listens on a Pico's other core,
/// nothing listens after begin(): then call parseSBusFrame() in loop(), as for a DecodeSBus.
///
/// It is not a DecodeSBus: make a function that takes either a template, such as
/// `template <typename Decoder> void open(Decoder &dSBus) { dSBus.begin(); }`.
///
/// `Decoder` is DecodeSBus, DecodeSBus24, DecodeSBus32, DecodeSBusNoPulses or DecodeSBusTelemetry.
template <typename Decoder>
using DecodeSBusBackgroundOf = typename Decoder::template PolledBy<sbus::PolledByTimer>;

#endif

/// Decodes like DecodeSBus, while loop() does other things.
using DecodeSBusBackground = DecodeSBusBackgroundOf<DecodeSBus>;
