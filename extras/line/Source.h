// SOURCE as the user writes it: a recording, a port or the simulated receiver, with disturbances.
#pragma once

#include <memory>
#include <string>

#include "line/Line.h"
#include "line/LineSettings.h"
#include "line/simulation/Choreography.h"
#include "line/simulation/SimulatedReceiver.h"

namespace line {

struct Source {
  std::string name;     // a file or port; empty: the simulated receiver
  bool silent = false;  // sends nothing
  // For the simulated receiver.
  Sticks sticks = Sticks::Flight;
  Channels channels = Channels::Sixteen;
  bool sbus2 = false;  // a Futaba with S.BUS2, and a sensor in slots 1 and 2; TX shares the wire
  unsigned noise = 0;  // disturbances per second
  LineSettings settings;
  // If true, a recording begins shortly after the port is opened, and a recording from a late port gets its gaps back.
  bool isForSketch = false;

  bool isSimulated() const { return name.empty(); }
  // Returns true if it would change a real line.
  bool disturbs() const { return noise > 0 || settings.idleHigh(); }

  // Opens a recording, or the simulated receiver. Throws std::runtime_error if the recording cannot be read.
  std::unique_ptr<Line> open() const;

  // Returns "simulated FrSky R-XSR", "recording line.txt, once" ...
  std::string text() const;
};

// Reads "sim", "flight.txt" or "/dev/ttyUSB0"; after a colon words: "sim:24,noise=30" or "flight.txt:uninverted".
// Throws std::runtime_error if a word is wrong.
//
//   16, 24, 32       channels of sim: 24 are FrSky's, 32 Futaba's FASSTest 26
//   sbus2            sim speaks S.BUS2
//   silent           sim sends nothing
//   calibration      the sticks of sim move for a calibration
//   noise=N          N disturbances a second, 1 to 100000, on sim or a file
//   uninverted       sim or a file is idle HIGH, like a receiver's uninverted pad
Source parseSource(const std::string &text);

}  // namespace line
