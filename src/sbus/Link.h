/// @file
/// Judges the link from the frames that came: may the numbers still be trusted?
#pragma once

#include <stdint.h>

#include "Frame.h"

namespace sbus {

/// What the frames tell of the link; NeverSeen before the first.
enum class LinkState : uint8_t {
  NeverSeen,  ///< no frame yet
  Ok,         ///< the newest frame is young, and its radio frame has arrived
  Lossy,      ///< the newest frame is young, but repeats old values (lost-frame flag); comes and goes in flight
  Failsafe,   ///< the receiver has given the link up, or has reported lost frames for too long
  Stale,      ///< no frame for as long as the timeout, or longer: wire, receiver or power
};

/// The link as its newest frame left it. Times are in us and wrap after 71 minutes. frame() is called once for each
/// frame, by whoever reads the port; it may interrupt state(), seen() and givenUp().
class Link {
 public:
  /// No frame yet.
  Link() { reset(); }

  static constexpr uint16_t DefaultTimeout = 100;    ///< ms: six frames of the slowest receiver known (15 ms)
  static constexpr uint16_t DefaultLossLimit = 100;  ///< frames: 0.6 to 1.5 s

  /// Forgets all frames, the state is NeverSeen; the settings stay.
  void reset();

  /// A link without a frame for so many ms is stale: 1..65535, DefaultTimeout unless told; 0: never.
  void setTimeout(uint16_t ms) { _timeout = ms; }

  /// So many frames with the lost-frame flag in a row are a failsafe, as some receivers never raise that
  /// flag: 1..65535, DefaultLossLimit unless told; 0: never.
  void setLossLimit(uint16_t frames) { _lossLimit = frames; }

  /// A frame with these flags (Frame.h) has come.
  void frame(uint8_t flags);

  /// A frame has come since reset().
  bool seen() const { return _state != LinkState::NeverSeen; }

  /// By the newest frame the receiver has given the link up, or has reported lost frames for too long. False before the
  /// first.
  bool givenUp() const { return _state == LinkState::Failsafe; }

  /// The link's state at `now`, if its newest frame came at `time`; NeverSeen before the first. Not const: what was
  /// found old never grows young again, so a sketch that asks once an hour is never told wrong.
  LinkState state(uint32_t time, uint32_t now) {
    const uint32_t before = _agedTime == time ? _age : 0;
    _agedTime = time;
    _age = now - time >= before ? now - time : UINT32_MAX;
    return isStale(_age) && seen() ? LinkState::Stale : _state;
  }

  /// True if a frame of this age, in us, is as old as the timeout.
  bool isStale(uint32_t age) const { return age >= _timeout * 1000UL && _timeout != 0; }

  /// Age of the newest frame in us when state() was called last; UINT32_MAX once the clock has wrapped. Of no meaning
  /// before the first.
  uint32_t age() const { return _age; }

 private:
  uint32_t _agedTime;  // of the frame whose age was asked last
  uint32_t _age;       // us, of that frame, when it was asked last
  uint16_t _timeout = DefaultTimeout;
  uint16_t _lossLimit = DefaultLossLimit;
  uint16_t _losses;  // lost frames in a row
  LinkState _state;  // of the newest frame, when it came
};

}  // namespace sbus
