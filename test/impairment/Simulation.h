// Runs a decoder on a simulated line, after a port's driver, inside a simulated sketch.
#pragma once

#include <cstdint>

#include "ImpairedLine.h"
#include "Judge.h"
#include "Setup.h"

enum class Reads { Channels16, Channels24, Channels32 };  // ours is a DecodeSBus, DecodeSBus24 or DecodeSBus32

struct Run {
  Transmission line{};  // its period is the setup's
  Setup setup{};
  Reads reads = Reads::Channels16;
  bool inStep = false;       // each loop takes exactly its period; otherwise its period +-10 %
  uint32_t blockFromUs = 0;  // a blocked loop takes from this
  uint32_t blockToUs = 0;    // to this time
  uint32_t blockEveryUs = 0;
  bool blocksInterrupts = false;  // they are off while the loop is blocked
  uint32_t workUs = 0;          // other work at the level of the port's calls, which wait for its end, takes this long
  uint32_t workEveryUs = 0;     // and begins again up to this long after its end
  uint32_t maskedUs = 0;        // interrupts are masked for this long, on a port that calls back
  uint32_t maskEveryUs = 0;     // from one mask's beginning to the next one's
  uint32_t maskUnsteadyUs = 0;  // up to this much later, drawn each time
  bool joining = false;         // the port is opened
  uint32_t joinUs = 0;          // this long after the line's first frame has begun
  uint32_t silenceUs = 20000;   // without `joining` this long before, and up to 9 ms longer
  bool everyLoop = false;       // makes also the calls in a silence that change nothing
};

enum class Decoder { Ours, Papers };

// Runs the decoder. In a silence it makes only the first call and the last before the next character: a receiver learns
// nothing from those in between. The baseline is polled by events.
//
// With a DecodeSBus32 the tally counts frames with both headers; late are only those with header 0F, since the others
// wait for what follows them.
Tally simulate(const Run &run, Decoder decoder, uint64_t seed);
