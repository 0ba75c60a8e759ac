// Runs a receiver on a simulated line, behind the board's receive path, inside a simulated sketch.
#pragma once

#include <cstdint>

#include "Judge.h"
#include "WireLine.h"

struct Run {
  Transmission line{};
  uint32_t loopUs = 50;     // a pass of loop()
  bool steady = false;      // exactly so long, else give or take 10 %
  bool byteByByte = false;  // the port hands over each byte, as without DMA (Serial3, AVR)
  uint32_t blockUs = 0;     // one pass lasts so long
  uint32_t blockEveryUs = 500000;
  bool joining = false;     // the port is opened so long after the line's first frame has begun
  uint32_t joinUs = 0;
};

// The same in slow motion: at half the baud rate, with all times twice as long, those at random too. For Kind::Plain:
// what other receivers send has times of its own.
Run slowMotion(Run run);

enum class Way { Ours, Papers };

// Ours is class DecodeSBus. It is called after a pass if bytes wait, as from serialEvent1().
Tally simulate(const Run &run, Way way, uint64_t seed);
