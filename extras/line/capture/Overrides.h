// Options that overrule a capture's own information.
#pragma once

#include <optional>
#include <string>

#include "line/LineSettings.h"

namespace line {

struct Overrides {
  std::string signal;                    // the only signal to decode; empty: all
  unsigned long baud = 0;                // 0: 100000 or 200000, whichever fits
  Polarity polarity = Polarity::Either;  // Either: whichever fits
  double periodNs = 0;                   // between two samples; 0: the capture's own
  std::optional<double> threshold;       // for voltages, in the capture's unit; nothing: detected
};

}  // namespace line
