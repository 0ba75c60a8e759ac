#include "Scaling.h"

#include "Frame.h"

namespace sbus {

namespace {

struct Points {
  int32_t low;
  int32_t centre;
  int32_t high;
};

constexpr Points Pulses = {LowPulse, CentrePulse, HighPulse};
constexpr Points Thousandths = {-1000, 0, 1000};

Points pointsOf(const Range &range) { return {range.low, range.centre, range.high}; }

// Rounds to the nearest, and halves away from 0.
int32_t divided(int32_t dividend, int32_t divisor) {
  const int32_t half = (divisor < 0 ? -divisor : divisor) / 2;
  return (dividend < 0 ? dividend - half : dividend + half) / divisor;
}

// Converts along two straight lines that meet in the centre.
int32_t converted(int32_t value, const Points &from, const Points &to) {
  const int32_t distance = value - from.centre;
  const bool high = (distance < 0) == (from.high < from.centre);
  const int32_t length = (high ? from.high : from.low) - from.centre;
  if (length == 0) {
    return to.centre;
  }
  return to.centre + divided(distance * ((high ? to.high : to.low) - to.centre), length);
}

int16_t narrow(int32_t value) {
  return static_cast<int16_t>(value < -INT16_MAX ? -INT16_MAX : value > INT16_MAX ? INT16_MAX : value);
}

uint16_t rawOf(int32_t value) { return static_cast<uint16_t>(value < 0 ? 0 : value > ChannelMax ? ChannelMax : value); }

}  // namespace

int16_t toMicroseconds(uint16_t raw, const Range &range) { return narrow(converted(raw, pointsOf(range), Pulses)); }

uint16_t fromMicroseconds(int16_t us, const Range &range) { return rawOf(converted(us, Pulses, pointsOf(range))); }

int16_t toNormalized(uint16_t raw, const Range &range) { return narrow(converted(raw, pointsOf(range), Thousandths)); }

uint16_t fromNormalized(int16_t thousandths, const Range &range) {
  return rawOf(converted(thousandths, Thousandths, pointsOf(range)));
}

}  // namespace sbus
