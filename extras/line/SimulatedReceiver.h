// A receiver, so that a sketch can be seen at work without one: an FrSky R-XSR, 111 frames a second.
#pragma once

#include "Choreography.h"
#include "Line.h"
#include "sbus/Frame.h"

namespace line {

class SimulatedReceiver : public Line {
 public:
  explicit SimulatedReceiver(const Choreography &choreography = Flight, uint32_t characterUs = CharacterUs);
  bool next(uint64_t nowUs, Character &character) override;

 private:
  void makeFrame();

  const Choreography &_choreography;
  uint32_t _characterUs;
  uint32_t _frameNumber = 0;
  uint8_t _index = 0;  // of the next character in `_frame`
  uint8_t _frame[sbus::FrameSize];
  uint16_t _channels[sbus::ChannelCount];  // as last received from the radio
};

}  // namespace line
