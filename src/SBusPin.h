/// @file
/// An S.Bus line straight on a pin of an AVR: no inverter, and Serial stays free.
#pragma once

#include <Arduino.h>

#include "port/EdgeDecoder.h"
#include "port/PortKind.h"

#if !defined(SBUS_PIN)
#error "SBusPin needs an ATmega328P, 168, 1280, 2560 or 1284P at 16 MHz. Use a serial port: extras/docs/sbuspin.md"
#else

/// A port that receives an S.Bus line on a pin: Uno R3, Nano, Pro Mini 7; Mega 5; ATmega1284P 3 (PB3).
///
///     SBusPin pin;
///     DecodeSBus dSBus(pin);
///     void setup() { dSBus.begin(); }
///
/// The pin belongs to the analog comparator, which compares it with 1.1 V and feeds the capture unit of timer 1. An
/// interrupt notes when each edge came. If interrupts were off for too long, it knows that it missed edges, and drops
/// the character: a frame may get lost, but it is never wrong. The decoder's begin() opens the pin, at 100000 baud
/// alone, inverted or sbus::Uninverted, and its end() gives back timer and comparator. Only one object can be open at a
/// time: the other receives nothing.
///
/// While it is open, timer 1 counts from 0 to 65535 in steps of 0.5 us. Its compare units remain usable; analogWrite()
/// on its pins (Uno: 9, 10; Mega: 11, 12) and the library Servo are not: extras/docs/sbuspin.md.
class SBusPin : public Stream {
 public:
  static constexpr uint8_t Pin = SBUS_PIN;  ///< the board's number of the pin

  SBusPin() {}
  SBusPin(const SBusPin &) = delete;             ///< two objects would share a timer
  SBusPin &operator=(const SBusPin &) = delete;  ///< not copied

  /// Opens the pin; DecodeSBus::begin() calls it. Returns false, and opens nothing, if another object is open.
  bool begin(bool inverted = true);

  /// Closes the pin, and gives timer and comparator back as they were.
  void end();

  /// Returns how many characters wait; 1 if some were lost before these. Call it at least every 5 ms: 255 edges are
  /// held, two frames or less.
  int available() override;
  /// Returns and removes the oldest character that waits. Returns -1 if there is none, and once after each loss.
  int read() override;
  /// Returns what read() would return.
  int peek() override;
  /// Sends nothing, and returns 0.
  size_t write(uint8_t) override { return 0; }
  using Print::write;

  /// @cond  For the classes of this library.

  // The kind of port, for PortKind.h.
  struct PortKind : sbus::Kind {
    static constexpr bool Inverts = true, BothWays = true, Sends = false;
    static constexpr unsigned Buffer = 4 * sbus::EdgeDecoder::Room;  // never full: read() tells a loss
    static constexpr sbus::ReceiveNotice Notice = sbus::ReceiveNotice::EachCharacter;  // from its first stop bit on
    template <typename Port, typename Pins>
    static unsigned open(Port &port, unsigned long baud, sbus::Config config, Pins) {
      port.end();
      if (baud == sbus::Baud) {
        port.begin(config.inverted());
      }
      return Buffer;
    }
  };

  /// @endcond

 private:
  int decode();
  int readLate();
  uint8_t firstBefore(uint8_t head);
  void setTail(uint8_t tail);

  uint8_t _tail = 0;  // place of the oldest edge that has not been decoded
  sbus::EdgeDecoder _decoder;
};

#endif
