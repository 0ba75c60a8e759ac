// Options that overrule what is found in a capture.
#pragma once

#include <optional>
#include <string>

#include "line/LineSettings.h"

namespace line {

struct Overrules {
  std::string signal;                    // the only one to look at; empty: all
  unsigned long baud = 0;                // 0: 100000 or 200000, whichever fits
  Polarity polarity = Polarity::Either;  // Either: whichever fits
  double periodNs = 0;                   // between two samples; 0: as the capture says
  std::optional<double> threshold;       // of voltages, in the capture's unit; none: it is found
};

}  // namespace line
