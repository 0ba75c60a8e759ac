// What the pilot's sticks put into the frames: the payload decides how easily a receiver is misled.
#pragma once

#include <BitByBit.h>

#include <vector>

#include "Random.h"

enum class Sticks {
  Uniform,        // every channel anywhere, anew in every frame
  Smooth,         // every channel moves by at most 20 a frame
  Neutral,        // a real frame of a FrSky receiver: 0F twice in the payload, every frame the same
  Still,          // any values, standing still for 500 frames
  Of0FAnd00,      // every payload byte is a header or an end byte
  All0F,          // every payload byte is a header
  Shifted,        // the payload looks like a whole frame at another alignment; moving
  ShiftedStill,   // the same, standing still
  LowChannel16,   // smooth, but CH16 at its low end: the end of a frame looks like its middle
};

const char *name(Sticks sticks);

// Gentle ones, such as occur in flight; Standing ones; Adversarial ones, made to deceive.
const std::vector<Sticks> &gentleSticks();
const std::vector<Sticks> &standingSticks();
const std::vector<Sticks> &adversarialSticks();
const std::vector<Sticks> &allSticks();

// Makes frames with end byte 00. Of the moving ones 2 % carry the lost-frame flag.
class StickFrames {
 public:
  StickFrames(Sticks sticks, Random &random);
  Frame next();

 private:
  Frame anyFrame();
  void disguise(Frame &frame);
  void moveSmoothly();

  static constexpr unsigned StandingFrames = 500;

  const Sticks _sticks;
  Random &_random;
  unsigned _number = 0;
  unsigned _place = 0;  // of the header in the payload, if shifted
  Channels _channels{};
  Frame _still{};
};
