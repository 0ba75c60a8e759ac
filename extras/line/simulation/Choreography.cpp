#include "line/simulation/Choreography.h"

#include "line/simulation/Hand.h"
#include "sbus/Frame.h"

namespace line {

namespace {

constexpr uint32_t FlightMs = 15000;
constexpr uint32_t RadioOffMs = 9500;
constexpr uint32_t FailsafeMs = 10000;  // after half a second of lost frames the receiver is in failsafe
constexpr uint32_t RadioOnMs = 12500;

Radio flightRadio(uint32_t frameNumber, uint32_t ms) {
  const bool off = ms >= RadioOffMs && ms < RadioOnMs;
  if (off && ms >= FailsafeMs) {
    return Radio::Failsafe;
  }
  return off || isLostInFlight(frameNumber) ? Radio::Lost : Radio::Received;
}

void fly(uint32_t, uint32_t ms, uint16_t *channels) {
  std::fill_n(channels, sbus::ProportionalCount, Centre);
  channels[0] = stick(ms, 3100, 600);         // aileron
  channels[1] = stick(ms + 700, 4300, 450);   // elevator
  channels[2] = sweep(ms, 6000);              // throttle
  channels[3] = stick(ms + 1900, 5200, 300);  // rudder
  channels[4] = twoPositions(ms, 2500);
  channels[5] = threePositions(ms, 1700);
  channels[16] = ms / 2000 % 2;
  channels[17] = ms / 3000 % 2;
}

constexpr uint32_t CalibrationMs = 40000;
constexpr size_t SticksCount = 4;  // CH1..CH4: aileron, elevator (reversed), throttle, rudder
constexpr size_t HandCount = 6;    // and the two switches

// The positions with the sticks released and the throttle low; all but CH4 are trimmed.
constexpr uint16_t Trims[SticksCount] = {1000, 985, Low, 992};

void sweepAll(uint32_t, uint32_t ms, uint16_t *channels) {
  channels[0] = sweep(ms, 2800);
  channels[1] = sweep(ms, 3500);
  channels[2] = sweep(ms, 4000);
  channels[3] = sweep(ms, 2000);
  channels[4] = twoPositions(ms, 1500);
  channels[5] = threePositions(ms, 1100);
}

void resetSwitches(uint16_t *channels) {
  channels[4] = Low;
  channels[5] = Centre;
}

// A potentiometer is never quite still, but the throttle rests against its stop.
void rest(uint32_t frameNumber, uint32_t, uint16_t *channels) {
  constexpr int Jitter[] = {0, 1, 0, -1, 0, 0, 1, -1};
  for (uint32_t i = 0; i < SticksCount; i++) {
    channels[i] = static_cast<uint16_t>(Trims[i] + (Trims[i] == Low ? 0 : Jitter[(frameNumber + 3 * i) % 8]));
  }
  resetSwitches(channels);
}

void holdUpRight(uint32_t, uint32_t, uint16_t *channels) {
  std::fill_n(channels, SticksCount, High);
  channels[1] = Low;
  resetSwitches(channels);
}

void flyGently(uint32_t, uint32_t ms, uint16_t *channels) {
  channels[0] = stick(ms, 3100, 300, Trims[0]);
  channels[1] = stick(ms + 700, 4300, 250, Trims[1]);
  channels[2] = stick(ms + 1300, 6000, 200);
  channels[3] = stick(ms + 1900, 5200, 200, Trims[3]);
  resetSwitches(channels);
}

// The hands glide from one section to the next.
struct Section {
  uint32_t fromMs;
  uint32_t untilMs;
  void (*move)(uint32_t frameNumber, uint32_t ms, uint16_t *channels);
};
constexpr Section Sections[] = {
    {0, 14000, sweepAll},
    {15000, 22000, rest},
    {23000, 28000, holdUpRight},
    {29000, 39500, flyGently},
    {CalibrationMs, CalibrationMs, sweepAll},  // as at 0
};

void glide(const Section &left, const Section &right, uint32_t frameNumber, uint32_t ms, uint16_t *channels) {
  uint16_t from[HandCount];
  uint16_t to[HandCount];
  left.move(frameNumber, left.untilMs, from);
  right.move(frameNumber, right.fromMs % CalibrationMs, to);
  const int passed = static_cast<int>(ms - left.untilMs);
  const int whole = static_cast<int>(right.fromMs - left.untilMs);
  for (size_t i = 0; i < SticksCount; i++) {
    channels[i] = static_cast<uint16_t>(from[i] + (to[i] - from[i]) * passed / whole);
  }
  std::copy(to + SticksCount, to + HandCount, channels + SticksCount);
}

void moveToCalibrate(uint32_t frameNumber, uint32_t ms, uint16_t *channels) {
  std::fill_n(channels, sbus::ProportionalCount, Centre);
  std::fill_n(channels + sbus::ProportionalCount, sbus::ChannelCount - sbus::ProportionalCount, uint16_t{0});
  const Section *section = Sections;
  while (ms >= section[1].fromMs) {
    section++;
  }
  if (ms < section->untilMs) {
    section->move(frameNumber, ms, channels);
  } else {
    glide(section[0], section[1], frameNumber, ms, channels);
  }
}

Radio calibrationRadio(uint32_t frameNumber, uint32_t) {
  return isLostInFlight(frameNumber) ? Radio::Lost : Radio::Received;
}

}  // namespace

const Choreography Flight = {FlightMs, flightRadio, fly};
const Choreography CalibrationMoves = {CalibrationMs, calibrationRadio, moveToCalibrate};

}  // namespace line
