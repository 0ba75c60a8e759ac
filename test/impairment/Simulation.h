// Runs a decoder on a simulated line, after a port's driver, inside a simulated sketch.
#pragma once

#include <cstdint>

#include "ImpairedLine.h"
#include "Judge.h"
#include "Setup.h"

struct Run {
  Transmission line{};  // its period is the setup's
  Setup setup{};
  bool reads24 = false;      // ours is class DecodeSBus24, otherwise DecodeSBus
  bool inStep = false;       // a loop takes exactly its period, otherwise within 10 % of it
  uint32_t blockFromUs = 0;  // one loop takes so long
  uint32_t blockToUs = 0;    // or up to so long
  uint32_t blockEveryUs = 0;
  bool joining = false;      // the port is opened so long after the line's first frame has begun
  uint32_t joinUs = 0;
  uint32_t silenceUs = 20000;  // else so long before, and up to 9 ms longer
  bool everyLoop = false;    // also those in a silence that change nothing
};

enum class Decoder { Ours, Papers };

// In a silence only the first call and the last before the next character are made: a receiver learns no more from
// those in between. The paper's decoder is polled by events.
//
// Of a line with Futaba's further channels (Kind::With2F) the tally is that of both kinds of frames; late are those
// with header 0F only: the others wait for what follows them.
Tally simulate(const Run &run, Decoder decoder, uint64_t seed);
