// What the user knows better than a capture tells.
#pragma once

#include <optional>
#include <string>

#include "line/simulation/LineSettings.h"

namespace line {

struct Overrules {
  std::string signal;                    // The only one that is looked at. Empty: all
  unsigned long baud = 0;                // 0: 100000 or 200000, whichever fits
  Polarity polarity = Polarity::Either;  // Either: whichever fits
  double periodNs = 0;                   // between two samples. 0: what the capture says
  std::optional<double> threshold;       // of voltages, in the capture's unit. None: it is found
};

}  // namespace line
