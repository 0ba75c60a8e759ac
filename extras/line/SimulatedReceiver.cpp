#include "SimulatedReceiver.h"

#include <algorithm>

#include "Hand.h"

namespace line {

namespace {

constexpr uint32_t FrameMs = 9;     // T of the paper's R-XSR
constexpr uint64_t FirstUs = 5000;  // the first frame begins 5 ms after the program

constexpr size_t Throttle = 2;  // CH3

void failsafe(uint16_t *channels) {
  std::fill_n(channels, sbus::ProportionalCount, Centre);
  channels[Throttle] = Low;
  channels[16] = 0;
  channels[17] = 0;
}

}  // namespace

SimulatedReceiver::SimulatedReceiver(const Choreography &choreography, uint32_t characterUs)
    : _choreography(choreography), _characterUs(characterUs) {
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
  const uint32_t ms = static_cast<uint32_t>(uint64_t{_frameNumber} * FrameMs % _choreography.periodMs);
  const Radio radio = _choreography.radio(_frameNumber, ms);
  if (radio == Radio::GivenUp) {
    failsafe(_channels);
  } else if (radio == Radio::Heard) {
    _choreography.move(_frameNumber, ms, _channels);
  }
  sbus::pack(_frame, _channels, radio == Radio::GivenUp, radio != Radio::Heard);
}

}  // namespace line
