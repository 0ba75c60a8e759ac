#include "line/simulation/SimulatedReceiver.h"

#include <algorithm>
#include <iterator>

#include "line/simulation/Hand.h"

namespace line {

namespace {

constexpr uint32_t FrameUs = 9000;  // T of the paper's R-XSR
constexpr uint32_t PairUs = 18000;  // from 2F to 2F: 18..20 ms according to INAV's pull request 10270
constexpr uint32_t GapUs = 1000;    // between the two; assumed
constexpr uint64_t FirstUs = 5000;  // the first frame begins 5 ms after the program

constexpr size_t Throttle = 2;   // CH3
constexpr size_t HandCount = 6;  // the choreography moves CH1..CH6 on every line

}  // namespace

SimulatedReceiver::SimulatedReceiver(const Choreography &choreography, uint32_t characterUs, Channels channels,
                                     uint32_t periodUs)
    : _choreography(choreography),
      _characterUs(characterUs),
      _kind(channels),
      _periodUs(periodUs != 0                     ? periodUs
                : channels == Channels::ThirtyTwo ? PairUs
                                                  : FrameUs) {
  makeFrame();
}

bool SimulatedReceiver::next(uint64_t nowUs, Character &character) {
  const uint64_t beginUs = FirstUs + uint64_t{_frameNumber} * _periodUs;
  const bool second = _kind == Channels::ThirtyTwo && _index >= sbus::FrameSize;
  const uint64_t endUs = beginUs + (_index + 1u) * _characterUs + (second ? GapUs : 0);
  if (endUs > nowUs) {
    return false;
  }
  character.endUs = endUs;
  character.value = _frames[_index];
  character.bad = false;
  _index++;
  if (_index == _size) {
    _index = 0;
    _frameNumber++;
    makeFrame();
  }
  return true;
}

// Beyond the hand's six, each channel swings by 100. Higher channels swing around higher values and more slowly, so
// that curves differ.
void SimulatedReceiver::move(uint32_t ms) {
  uint16_t channels[sbus::ChannelCount];
  _choreography.move(_frameNumber, ms, channels);
  std::copy_n(channels, sbus::ProportionalCount, _channels);
  std::copy_n(channels + sbus::ProportionalCount, std::size(_switches), _switches);
  for (uint32_t i = HandCount; i < MostChannels && _kind != Channels::Sixteen; i++) {
    const uint32_t number = i + 1;
    _channels[i] = stick(ms, 2000 + 100 * number, 100, static_cast<uint16_t>(100 + 50 * number));
  }
}

void SimulatedReceiver::makeFrame() {
  const uint32_t ms = static_cast<uint32_t>(uint64_t{_frameNumber} * _periodUs / 1000 % _choreography.periodMs);
  const Radio radio = _choreography.radio(_frameNumber, ms);
  if (radio == Radio::Failsafe) {
    std::fill_n(_channels, MostChannels, Centre);
    _channels[Throttle] = Low;
    std::fill_n(_switches, std::size(_switches), uint16_t{0});
  } else if (radio == Radio::Received) {
    move(ms);
  }
  const bool failsafe = radio == Radio::Failsafe;
  const bool lostFrame = radio != Radio::Received;
  if (_kind == Channels::TwentyFour) {
    sbus::pack24(_frames, _channels, failsafe, lostFrame);
    _size = sbus::FrameSize24;
    return;
  }
  _size = 0;
  if (_kind == Channels::ThirtyTwo) {
    add(sbus::ExtraHeader, _channels + sbus::ProportionalCount, failsafe, lostFrame);
  }
  add(sbus::HeaderByte, _channels, failsafe, lostFrame);
}

// Both frames have the same digital channels and flags.
void SimulatedReceiver::add(uint8_t header, const uint16_t *proportional, bool failsafe, bool lostFrame) {
  uint16_t channels[sbus::ChannelCount];
  std::copy_n(proportional, sbus::ProportionalCount, channels);
  std::copy_n(_switches, std::size(_switches), channels + sbus::ProportionalCount);
  sbus::pack(_frames + _size, channels, failsafe, lostFrame);
  _frames[_size] = header;
  _size = static_cast<uint8_t>(_size + sbus::FrameSize);
}

}  // namespace line
