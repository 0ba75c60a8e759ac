#include "SimulatedReceiver.h"

#include <algorithm>
#include <cstdlib>

namespace host {

namespace {

constexpr uint32_t FrameMs = 9;       // T of the paper's R-XSR
constexpr uint64_t FirstUs = 5000;    // the first frame begins 5 ms after the program
constexpr uint32_t FlightMs = 15000;  // everything begins again after it
constexpr uint32_t RadioOffMs = 9500;
constexpr uint32_t FailsafeMs = 10000;  // half a second of lost frames, then the receiver gives up
constexpr uint32_t RadioOnMs = 12500;

constexpr uint16_t Low = 172;
constexpr uint16_t Centre = 992;
constexpr uint16_t High = 1811;

constexpr size_t Throttle = 2;  // CH3

// Up and down in straight lines, -1024..1024, beginning at 0.
int triangle(uint32_t ms, uint32_t periodMs) {
  const uint32_t phase = (ms + periodMs / 4) % periodMs;
  const int rising = static_cast<int>(phase * 4096 / periodMs) - 1024;  // -1024..3071
  return rising <= 1024 ? rising : 2048 - rising;
}

// A stick as a hand moves it: a triangle with its corners made round, near enough to a sine.
uint16_t stick(uint32_t ms, uint32_t periodMs, int travel) {
  const int x = triangle(ms, periodMs);
  const int rounded = x * (2048 - std::abs(x)) / 1024;
  return static_cast<uint16_t>(Centre + travel * rounded / 1024);
}

// From one end to the other and back, staying at either long enough (0.1 periods) to be seen there. Begins low.
uint16_t sweep(uint32_t ms, uint32_t periodMs) {
  const int x = triangle(ms + periodMs * 3 / 4, periodMs) * 5 / 4;
  return static_cast<uint16_t>(Low + (High - Low) * (std::clamp(x, -1024, 1024) + 1024) / 2048);
}

void fly(uint32_t ms, uint16_t *channels) {
  constexpr uint16_t Switch[] = {Low, Centre, High};
  std::fill_n(channels, sbus::ProportionalCount, Centre);
  channels[0] = stick(ms, 3100, 600);         // aileron
  channels[1] = stick(ms + 700, 4300, 450);   // elevator
  channels[Throttle] = sweep(ms, 6000);
  channels[3] = stick(ms + 1900, 5200, 300);  // rudder
  channels[4] = Switch[ms / 2500 % 2 * 2];    // two positions
  channels[5] = Switch[ms / 1700 % 3];        // three positions
  channels[16] = ms / 2000 % 2;
  channels[17] = ms / 3000 % 2;
}

void failsafe(uint16_t *channels) {
  std::fill_n(channels, sbus::ProportionalCount, Centre);
  channels[Throttle] = Low;
  channels[16] = 0;
  channels[17] = 0;
}

// Two frames in a row, every 0.9 s.
bool isLostInFlight(uint32_t frameNumber) {
  return frameNumber % 100 >= 60 && frameNumber % 100 < 62;
}

}  // namespace

SimulatedReceiver::SimulatedReceiver(uint32_t characterUs) : _characterUs(characterUs) {
  makeFrame();
}

bool SimulatedReceiver::next(uint64_t nowUs, Character &character) {
  const uint64_t beginUs = FirstUs + uint64_t{_frameNumber} * FrameMs * 1000;
  const uint64_t endUs = beginUs + (_index + 1u) * _characterUs;
  if (endUs > nowUs) {
    return false;
  }
  character.endUs = endUs;
  character.value = _frame[_index];
  character.bad = false;
  _index++;
  if (_index == sbus::FrameSize) {
    _index = 0;
    _frameNumber++;
    makeFrame();
  }
  return true;
}

void SimulatedReceiver::makeFrame() {
  const uint32_t ms = static_cast<uint32_t>(uint64_t{_frameNumber} * FrameMs % FlightMs);
  const bool radioOff = ms >= RadioOffMs && ms < RadioOnMs;
  const bool givenUp = radioOff && ms >= FailsafeMs;
  const bool lost = radioOff || isLostInFlight(_frameNumber);
  if (givenUp) {
    failsafe(_channels);
  } else if (!lost) {
    fly(ms, _channels);
  }
  sbus::pack(_frame, _channels, givenUp, lost);
}

}  // namespace host
