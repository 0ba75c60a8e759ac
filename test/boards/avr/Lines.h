// The lines of the tests.
#pragma once

#include <cstdint>
#include <string>

#include "AvrBoard.h"
#include "line/Source.h"

namespace avr {

// "flight", "calibration": the simulated receiver; "cut": a flight that falls silent after 2 s; "silent"; "wire": from
// TX1; otherwise a recording.
inline Line lineOf(const std::string &name) {
  line::Source source;
  source.silent = name == "silent";
  source.sticks = name == "calibration" ? line::Sticks::Calibration : line::Sticks::Flight;
  if (name != "flight" && name != "cut" && name != "calibration" && name != "silent" && name != "wire") {
    source.name = "../../recordings/" + name + ".txt";
  }
  Line line;
  line.source = name == "wire" ? nullptr : source.open();
  line.cutUs = name == "cut" ? 2000000 : line.cutUs;
  return line;
}

}  // namespace avr
