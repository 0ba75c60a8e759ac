// Runs a receiver on a simulated line, behind a port's driver, inside a simulated sketch.
#pragma once

#include <cstddef>
#include <cstdint>

#include "Judge.h"
#include "WireLine.h"

// Hands so many characters over at once, or fewer when the line has been idle for so long.
struct Driver {
  const char *name;
  unsigned burst;
  unsigned idleCharacters;

  bool isBoards() const { return burst == 16; }
};
constexpr Driver Board = {"board", 16, 1};  // half of its DMA's ring
constexpr Driver Bytes = {"bytes", 1, 0};   // AVR
constexpr Driver Fifo = {"FIFO 8", 8, 3};   // RP2040: when it has been idle for 32 bits
constexpr Driver Esp32 = {"ESP32", 120, 2};

struct Setup {
  uint32_t periodUs;
  uint32_t loopUs;
  Driver driver = Board;
  size_t buffer = 64;
};

struct Run {
  Transmission line{};  // its period is the setup's
  Setup setup{};
  bool inStep = false;       // a loop takes exactly its period, else give or take 10 %
  uint32_t blockFromUs = 0;  // one loop takes so long
  uint32_t blockToUs = 0;    // or up to so long
  uint32_t blockEveryUs = 0;
  bool joining = false;      // the port is opened so long after the line's first frame has begun
  uint32_t joinUs = 0;
};

enum class Way { Ours, Papers };

// Ours is class DecodeSBus. It is called after a loop if bytes wait, as from serialEvent1().
Tally simulate(const Run &run, Way way, uint64_t seed);
