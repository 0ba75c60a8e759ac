// Chooses a line: a recording, the simulated receiver, or nothing; and its disturbances.
#pragma once

#include <memory>
#include <string>

#include "line/simulation/Choreography.h"
#include "line/Line.h"
#include "line/simulation/LineSettings.h"
#include "line/simulation/SimulatedReceiver.h"

namespace line {

struct Source {
  std::string recording;  // a file's name; empty: the simulated receiver
  bool silent = false;    // nothing comes
  // Of the simulated receiver.
  Sticks sticks = Sticks::Flight;
  Channels channels = Channels::Sixteen;
  bool sbus2 = false;  // a Futaba with S.BUS2, a sensor in slots 1 and 2; TX shares the wire
  unsigned noise = 0;  // disturbances per second
  LineSettings settings;
  // If true, a recording begins a moment after the port is opened, and that of a late port gets its gaps back.
  bool isForSketch = false;

  // Opens the line. Throws std::runtime_error if the recording cannot be read.
  std::unique_ptr<Line> open() const;

  // Returns "simulated FrSky R-XSR", "recording line.txt, once" ...
  std::string text() const;
};

}  // namespace line
