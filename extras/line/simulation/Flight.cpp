#include "line/simulation/Choreography.h"
#include "line/simulation/Hand.h"
#include "sbus/Frame.h"

namespace line {

namespace {

constexpr uint32_t FlightMs = 15000;
constexpr uint32_t RadioOffMs = 9500;
constexpr uint32_t FailsafeMs = 10000;  // after half a second of lost frames the receiver is in failsafe
constexpr uint32_t RadioOnMs = 12500;

Radio radio(uint32_t frameNumber, uint32_t ms) {
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

}  // namespace

const Choreography Flight = {FlightMs, radio, fly};

}  // namespace line
