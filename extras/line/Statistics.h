// Statistics of frames, or of a sketch's rows: their rate, the newest values, the sticks' travel.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "line/DetectedVariant.h"
#include "line/Jumps.h"
#include "line/Segments.h"
#include "line/SmoothedLink.h"
#include "sbus/Diagnosis.h"
#include "sbus/Link.h"

namespace line {

// The lowest and the highest value since the last reset.
struct Extent {
  uint64_t count = 0;  // number of values; 0: all members are 0
  uint64_t low = 0;
  uint64_t high = 0;
  uint64_t sum = 0;

  void add(uint64_t value);
  uint64_t mean() const { return count == 0 ? 0 : (sum + count / 2) / count; }
};

// Tracks when frames or rows arrive, and derives the state of the link.
class Arrivals {
 public:
  explicit Arrivals(uint16_t timeoutMs = sbus::Link::DefaultTimeout) { _link.setTimeout(timeoutMs); }

  // Returns the state at `nowUs`, or at the latest time of an earlier call: for the link, time never goes back.
  sbus::LinkState state(uint64_t nowUs);
  // Return the state to show at that time, and the indicators.
  sbus::LinkState heldState(uint64_t nowUs) { return _held.state(state(nowUs), nowUs); }
  bool showsLostFrame(uint64_t nowUs) const { return _held.showsLostFrame(nowUs); }
  bool showsFailsafe(uint64_t nowUs) const { return _held.showsFailsafe(nowUs); }
  // Returns true if the newest one is in failsafe, or ends too long a run of lost frames, like a sketch's `failsafe`.
  bool inFailsafe() const { return _link.isFailsafe(); }
  // Returns the age of the newest one in us; undefined while state() is NeverSeen.
  uint64_t ageUs(uint64_t nowUs) const { return nowUs - std::min(nowUs, _newestUs); }
  // Returns the number of frames or rows within the last second.
  unsigned perSecond(uint64_t nowUs) const { return _held.perSecond(nowUs); }
  // Returns the frame intervals in us, from end to end.
  const Extent &gaps() const { return _gaps; }

 protected:
  void setTimeout(uint16_t ms) { _link.setTimeout(ms); }
  // Takes a frame or row with its flags.
  void add(uint64_t nowUs, uint8_t flags);
  void resetMarks() { _gaps = Extent(); }

 private:
  sbus::Link _link;
  SmoothedLink _held;
  uint64_t _newestUs = 0;
  uint64_t _askedUs = 0;  // the latest time passed to state()
  Extent _gaps;
};

// The newest values. All 0 before the first frame.
struct Values {
  uint64_t endUs = 0;              // when the frame was complete
  unsigned count = 0;              // 16, 24, or 32 on a line with frames with header 2F
  std::array<uint16_t, 32> raw{};  // CH1.., 0..2047
  std::array<bool, 2> switches{};  // CH17 and CH18 of a line with 16 channels
  bool lostFrame = false;          // the frame's flag
  bool failsafe = false;           // the frame's flag

  // Returns true if the receiver has lost the radio but does not say so by a flag: see sbus::Finding.
  bool hasNoPulses() const { return count > 0 && !lostFrame && !failsafe && sbus::hasNoPulses(raw.data()); }
};

// Returns the values with the switches and flags of another flags byte, as of a frame with header 2F: of that an
// Observer reports only the channels.
Values withFlags(Values values, uint8_t flagsByte);

class Statistics : public Arrivals {
 public:
  const Values &newest() const { return _newest; }
  // Returns the travel of a channel, counted from 0, in frames without a flag, since failsafe values are not stick
  // positions.
  const Extent &travel(size_t channel) const { return _travel[channel]; }
  const DetectedVariant &variant() const { return _variant; }
  // Returns how many frames had no pulses.
  uint32_t pulseless() const { return _pulseless; }
  // Returns the channels that have jumped in the frame before the newest, bit 0 for CH1; and how many frames had any.
  uint32_t jumped() const { return _jumped; }
  uint32_t jumps() const { return _jumpCount; }
  void resetMarks();

 protected:
  void add(const Stretch &frame);

 private:
  static constexpr unsigned ExtraWithin = 8, NoExtra = 50;  // frames

  Values _newest;
  DetectedVariant _variant;
  bool _has32 = false;  // two frames with header 2F came within ExtraWithin, and then always one within NoExtra
  unsigned _sinceExtra = NoExtra;  // frames since the newest of them, at most this many
  uint32_t _pulseless = 0;
  Jumps _jumps;
  uint32_t _jumped = 0;
  uint32_t _jumpCount = 0;
  std::array<Extent, 32> _travel{};
};

}  // namespace line
