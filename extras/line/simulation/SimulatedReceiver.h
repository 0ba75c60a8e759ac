// Simulates a receiver, to try a sketch without one: an FrSky R-XSR, 111 frames a second, or one with more channels.
#pragma once

#include "line/simulation/Choreography.h"
#include "line/Line.h"
#include "sbus/Frame.h"

namespace line {

// CH7 and above stay in the middle on a line with 16 channels, and move on a line with more.
enum class Channels : uint8_t {
  Sixteen,     // and two switches
  TwentyFour,  // FrSky, set to 24 channels: 36 bytes
  ThirtyTwo,   // Futaba FASSTest 26: every 18 ms a frame with header 2F, and 1 ms later one with 0F
};

class SimulatedReceiver : public Line {
 public:
  // `periodUs` is the frame period; 0: the real receiver's.
  explicit SimulatedReceiver(const Choreography &choreography = Flight, uint32_t characterUs = CharacterUs,
                             Channels channels = Channels::Sixteen, uint32_t periodUs = 0);
  bool next(uint64_t nowUs, Character &character) override;

 private:
  static constexpr size_t MostChannels = 32;

  void makeFrame();
  void move(uint32_t ms);
  void add(uint8_t header, const uint16_t *proportional, bool failsafe, bool lostFrame);

  const Choreography &_choreography;
  const uint32_t _characterUs;
  const Channels _kind;
  const uint32_t _periodUs;
  uint32_t _frameNumber = 0;
  uint8_t _index = 0;  // of the next character in `_frames`
  uint8_t _size = 0;   // characters in `_frames`
  uint8_t _frames[2 * sbus::FrameSize];
  uint16_t _channels[MostChannels];  // last received from the radio, all proportional
  uint16_t _switches[sbus::ChannelCount - sbus::ProportionalCount];
};

}  // namespace line
