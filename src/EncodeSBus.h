/// @file
/// Sends Futaba S.Bus through a serial port.
#pragma once

#include <Arduino.h>

#include "port/Port.h"
#include "sbus/Frame.h"

/// Sends to one serial port. A sketch needs two calls:
///
///     EncodeSBus sBus(Serial2);
///     void setup() { sBus.begin(); }
///     void loop() { sBus.write(channels, failsafe, lostFrame); }
///
/// EncodeSBus24 sends FrSky's 24 channels. If a DecodeSBus listens on the same port, call only the DecodeSBus's begin()
/// and end(). A port that the sketch has opened needs no begin(). Call all methods from setup(), loop() or
/// serialEventN(), never from an interrupt.
template <typename Format>
class EncodeSBusOf {
 public:
  /// Remembers `port`, and opens nothing yet: a hardware serial port, or any other Stream, which the sketch opens.
  /// `port` must outlive the object.
  template <typename Port>
  explicit EncodeSBusOf(Port &port) : _port(port) {
    static_assert(sbus::KindOf<Port>::Sends, "An SBusPin only receives: extras/docs/sbuspin.md");
  }

  /// Remembers `port` and its pins, on an ESP32 or ESP8266 (see DecodeSBusOf()).
  template <typename Port>
  EncodeSBusOf(Port &port, int8_t rx, int8_t tx) : _port(port, rx, tx) {}

  EncodeSBusOf(const EncodeSBusOf &) = delete;             ///< a copy would not know when the frame before was sent
  EncodeSBusOf &operator=(const EncodeSBusOf &) = delete;  ///< not copied

  /// Opens the port like DecodeSBus::begin(), and sends nothing.
  void begin(unsigned long baud = sbus::Baud, uint32_t config = sbus::Inverted) {
    _sent = false;
    _port.open(baud, config);
  }

  /// Closes a hardware serial port. Call it only after begin(). First the port sends the bytes that it holds, for up
  /// to 8 ms. Do not call write() afterwards: some ports do not notice that they are closed (AVR).
  void end() { _port.close(); }

  /// Sets the frame period, 0..65535 us; more counts as 65535. Default: 9000 us. A frame takes 3000 us (1500 us at
  /// 200000 baud), or 4320 us with 24 channels. Receivers need a gap after it, so set at least 4000 us (2000 us), or
  /// 6000 us for 24 channels. To forward a receiver's frames set this least period: with the receiver's own, half
  /// the calls come a little too early, and send nothing.
  void setPeriod(unsigned long us) { _period = static_cast<uint16_t>(us < UINT16_MAX ? us : UINT16_MAX); }

  /// Sends a frame if the period is over and the port takes the whole frame, and then returns true. The first call
  /// sends at once. Call it in every loop(), after begin(). Nothing else may write to the port.
  ///
  /// `channels` has 18 values: CH1..CH16, clamped to 2047, then CH17 and CH18, where any value but 0 is sent as 1.
  /// EncodeSBus24 takes 24 values, CH1..CH24, clamped to 2047.
  ///
  /// It does not wait if the port has room for 25 bytes. A port that never has that much room, or cannot say how much
  /// it has, gets the frame once it has the most room seen so far, and the core waits for up to 3 ms (Uno R4, mbed).
  /// The period is exact while a loop() takes less than half of the gap; after a longer loop() it starts from that
  /// frame.
  bool write(sbus::ChannelArray<const uint16_t, Format::Channels> channels, bool failsafe, bool lostFrame) {
    const uint32_t now = micros();
    const uint32_t late = now - _last - _period;  // us; wraps if it is early
    if ((_sent && now - _last < _period) || channels == nullptr) {
      return false;
    }
    // Some ports never have room for 25 bytes, and some report none: then the largest room seen is enough.
    const int room = _port.room();
    if (room > _room) {
      _room = static_cast<uint8_t>(room < Format::Size ? room : Format::Size);
    } else if (room < _room) {
      return false;
    }
    uint8_t frame[Format::Size];
    Format::pack(frame, channels, failsafe, lostFrame);
    if (!_port.write(frame, Format::Size)) {
      return false;
    }
    // If this frame is a little late, the next one is due as if it had been on time; otherwise a period from now. So no
    // gap is shorter than half of what the period gives: receivers need it.
    constexpr uint32_t FrameTime = uint32_t{Format::Size} * sbus::CharacterTime;
    const uint32_t tolerable = _period > FrameTime ? (_period - FrameTime) / 2 : 0;
    _last = _sent && late < tolerable ? now - late : now;
    _sent = true;
    return true;
  }

  /// Sends `frame` likewise: an SBusFrame, or an SBusFrame24 with EncodeSBus24. Until DecodeSBus::read() has returned
  /// true, its channels are 0, below every make's low: send nothing then, because S.Bus servos ignore the flags. In a
  /// frame that you fill yourself, set both flags: they begin as true.
  bool write(const typename Format::Value &frame) { return write(frame.channels, frame.failsafe, frame.lostFrame); }

 private:
  sbus::Port _port;
  uint32_t _last = 0;  // us, when the last frame was due
  uint16_t _period = 9000;
  uint8_t _room = 0;  // bytes: the most room that the port has reported, a frame at most
  bool _sent = false;
};

/// Sends sixteen channels and two switches.
using EncodeSBus = EncodeSBusOf<sbus::Frame16>;
/// Sends FrSky's 24 channels.
using EncodeSBus24 = EncodeSBusOf<sbus::Frame24>;
