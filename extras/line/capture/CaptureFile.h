// Captures in files.
#pragma once

#include <string>

#include "line/capture/WireDecoder.h"

namespace line {

struct CaptureEnd {
  std::string format;   // "PulseView CSV"
  double periodNs = 0;  // between two samples; 0 if it is not known
  std::string error;    // with the place in the file; what came before it was decoded. Empty if nothing is wrong
};

// Reads a capture to its end, or until something is wrong. `name`: a file, or "-" for standard input. Throws
// std::runtime_error if it cannot be opened, or is no capture.
CaptureEnd readCapture(const std::string &name, const Overrules &overrules, WireDecoder &decoder);

}  // namespace line
