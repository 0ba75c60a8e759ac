/// @file
/// Judges the link by the frames that came.
#pragma once

#include <stdint.h>

#include "Frame.h"

namespace sbus {

/// The state of the link; NeverSeen before the first frame.
enum class LinkState : uint8_t {
  NeverSeen,  ///< no frame yet
  Ok,         ///< the newest frame is younger than the timeout, and its radio frame arrived
  Lossy,      ///< the newest frame repeats old values (lost-frame flag); comes and goes in flight
  Failsafe,   ///< link lost: the receiver is in failsafe, or has reported lost frames for too long
  Stale,      ///< no frame within the timeout: wire, receiver or power
};

/// Returns true if a frame has come within the timeout.
inline bool isYoung(LinkState state) { return state != LinkState::NeverSeen && state != LinkState::Stale; }

/// Keeps the state of the link. Times are in us and wrap after 71 minutes. The context that reads the port calls
/// frame() once for each frame; frame() may interrupt the other methods: then call them again.
class Link {
 public:
  /// Starts without a frame.
  Link() { reset(); }

  static constexpr uint16_t DefaultTimeout = 100;    ///< ms: six frames of the slowest receiver known (15 ms)
  static constexpr uint16_t DefaultLossLimit = 100;  ///< frames: 0.6 to 1.5 s

  /// Forgets all frames: the state is NeverSeen. Keeps the settings.
  void reset() {
    _state = LinkState::NeverSeen;
    _losses = 0;
    _aged = 0;
  }

  /// Sets how many ms after the newest frame the link is stale, 1..65535; more counts as 65535. Default:
  /// DefaultTimeout. 0 disables this.
  void setTimeout(unsigned long ms) { _timeout = static_cast<uint16_t>(ms < UINT16_MAX ? ms : UINT16_MAX); }

  /// Sets how many frames in a row with the lost-frame flag count as failsafe, 1..65535: some receivers never set the
  /// failsafe flag. Default: DefaultLossLimit. 0 disables it.
  void setLossLimit(uint16_t frames) { _lossLimit = frames; }

  /// Takes the flags (Frame.h) of a frame that has come.
  void frame(uint8_t flags) {
    _aged = 0;
    if ((flags & (FlagLostFrame | FlagFailsafe)) == 0) {
      _losses = 0;
      _state = LinkState::Ok;
      return;
    }
    if ((flags & FlagLostFrame) == 0) {
      _losses = 0;
    } else if (_losses < UINT16_MAX) {
      _losses++;
    }
    const bool tooMany = _lossLimit != 0 && _losses >= _lossLimit;
    _state = tooMany || (flags & FlagFailsafe) != 0 ? LinkState::Failsafe : LinkState::Lossy;
  }

  /// Returns true if a frame has come since reset().
  bool seen() const { return _state != LinkState::NeverSeen; }

  /// Returns true if the newest frame says failsafe, or ends too long a run of lost frames; false before the first.
  bool isFailsafe() const { return _state == LinkState::Failsafe; }

  /// Returns the state at `now` if the newest frame came at `time`; NeverSeen before the first. It remembers old age,
  /// so that a stale frame stays stale when the clock wraps: call it at least once an hour.
  LinkState state(uint32_t time, uint32_t now) { return state(age(now - time)); }

  /// Returns the state if age() has returned `age`, us; NeverSeen before the first frame.
  LinkState state(uint32_t age) const { return isStale(age) && seen() ? LinkState::Stale : _state; }

  /// Extends `age`, us, of the newest frame by a clock that wraps: after 71 minutes returns UINT32_MAX until the next
  /// frame. Call it at least once an hour. Undefined before the first frame.
  uint32_t age(uint32_t age) {
    const uint8_t whole = static_cast<uint8_t>(age >> 24);
    const uint8_t aged = whole < Wrapped ? whole : Wrapped - 1;
    if (aged > _aged) {  // written as seldom as can be: frame() may have come since it was read
      _aged = aged;
    } else if (aged < _aged) {
      _aged = Wrapped;
      return UINT32_MAX;
    }
    return age;
  }

  /// Makes the newest frame as old as age() can say, until the next frame.
  void makeOld() { _aged = Wrapped; }

  /// Returns true if a frame of this age, in us, is as old as the timeout.
  bool isStale(uint32_t age) const { return age >= _timeout * 1000UL && _timeout != 0; }

 private:
  static constexpr uint8_t Wrapped = UINT8_MAX;

  uint16_t _timeout = DefaultTimeout;
  uint16_t _lossLimit = DefaultLossLimit;
  uint16_t _losses;  // lost frames in a row
  LinkState _state;  // of the newest frame, when it came
  uint8_t _aged;     // what age() returned last for the newest frame, in units of 16.8 s, 0..254; or Wrapped
};

}  // namespace sbus
