// What differs from sketch to sketch: the receiver's frame period, the loop period, the port.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "Payload.h"
#include "support/Driver.h"

// When the sketch calls parseSBusFrame().
enum class Polling {
  InLoop,    // in every loop()
  ByEvents,  // after a loop() if bytes wait, as from serialEvent1()
  Never,     // the port calls back
};

struct Setup {
  uint32_t periodUs;
  uint32_t loopUs;
  Driver driver = Board;
  size_t buffer = 64;
  Polling polling = Polling::InLoop;
  uint32_t callLateUs = 0;  // a port that calls back does so up to this much later than bytes were handed over

  bool callsBack() const { return polling == Polling::Never; }
};

// A port that calls back, whatever loop() does.
std::vector<Setup> calledBack(std::initializer_list<uint32_t> periodsUs, uint32_t lateUs = 0);

// Returns every driver with each of these periods and loops, and buffers of 256.
std::vector<Setup> everyDriver(std::initializer_list<uint32_t> periodsUs, std::initializer_list<uint32_t> loopsUs);

// Returns "T 9 ms, loop 50 us, board, 64".
std::string name(const Setup &setup);
