// A receiver, so that a sketch can be seen at work without one: an FrSky R-XSR in flight, 111 frames a second.
#pragma once

#include "Line.h"
#include "sbus/Frame.h"

namespace host {

// A flight of 15 s, over and over: the sticks move, a few frames are lost; at 9.5 s the radio is switched off, the
// receiver first loses frames, then goes into failsafe; at 12.5 s the radio is back. Integers only, so that every
// machine sends the same bytes.
class SimulatedReceiver : public Line {
 public:
  explicit SimulatedReceiver(uint32_t characterUs = CharacterUs);
  bool next(uint64_t nowUs, Character &character) override;

 private:
  void makeFrame();

  uint32_t _characterUs;
  uint32_t _frameNumber = 0;
  uint8_t _index = 0;  // of the next character in `_frame`
  uint8_t _frame[sbus::FrameSize];
  uint16_t _channels[sbus::ChannelCount];  // as last received from the radio
};

}  // namespace host
