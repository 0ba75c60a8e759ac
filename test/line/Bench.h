// Runs a receiver on a simulated line, behind the board's receive path, inside a simulated sketch.
#pragma once

#include <cstdint>

#include "Judge.h"
#include "WireLine.h"

struct Run {
  Impairments impairments{};
  Kind kind = Kind::Plain;
  Sticks sticks = Sticks::Neutral;
  uint32_t periodUs = 9000;
  uint32_t loopUs = 50;     // a pass of loop()
  bool steady = false;      // exactly so long, else give or take 10 %
  bool byteByByte = false;  // the port hands over each byte, as without DMA (Serial3, AVR)
  uint32_t blockUs = 0;     // one pass of every half second lasts so long
  uint64_t frames = 20000;
  bool joining = false;     // the port is opened so long after the line's first frame has begun
  uint32_t joinUs = 0;
};

enum class Way { Ours, Papers };

// Ours is class DecodeSBus. It is called after a pass if bytes wait, as from serialEvent1().
Tally simulate(const Run &run, Way way, uint64_t seed);
