// Payloads by the sticks' positions: they decide how easily a receiver is misled.
#pragma once

#include <vector>

#include "line/simulation/Random.h"
#include "support/BitByBit.h"

using line::Random;

enum class Payload {
  // Ordinary ones, such as receivers send.
  Uniform,       // every channel anywhere, different in every frame
  Smooth,        // every channel moves by at most 20 a frame
  Neutral,       // a real frame of a FrSky receiver: 0F twice in the payload, every frame the same
  Still,         // any values, standing still
  Equal,         // all channels at 0, 992, 1024 or anywhere, standing still
  Zeros,         // smooth, but some channels at 0: no pulses
  LowChannel16,  // smooth, but in every other frame CH16 is low: the frame's end looks like its middle; any flags
  // Those that allow a false sync: a real one, and others made up to deceive.
  Failsafe,      // a receiver's failsafe frame: from its flags to those of the next frame it looks like a frame
  Of0FAnd00,     // every payload byte is a header or an end byte
  All0F,         // every payload byte is a header
  Shifted,       // allows a false sync: looks like a frame from another place on; moving
  ShiftedStill,  // likewise, standing still
  OtherEnd,      // likewise, and the false sync has the end byte of another line variant
  SlotInside,    // any values, standing still; those of 24 channels look like 16 of S.BUS2, followed by a slot's ID
};

const char *name(Payload sticks);

const std::vector<Payload> &ordinarySticks();
const std::vector<Payload> &deceptiveSticks();

// Makes frames with end byte 00. 2 % of the moving frames have random flags.
class PayloadFrames {
 public:
  PayloadFrames(Payload sticks, Random &random);
  Frame next();

 private:
  void change();
  Frame anyFrame();
  void disguise(Frame &frame);
  void move();
  Frame packed();
  uint8_t flags();

  static constexpr unsigned StandingFrames = 500;

  const Payload _sticks;
  Random &_random;
  unsigned _number = 0;
  unsigned _place = 0;  // of the header of the false sync, if shifted: 2 to 23, which is the flags
  unsigned _zeros = 0;  // bits: these channels stand at 0
  Channels _channels{};
  Frame _still{};
};
