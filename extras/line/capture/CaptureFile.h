// Reads captures in files.
#pragma once

#include <string>

#include "line/capture/CaptureText.h"

namespace line {

// Reads a capture to its end, or until something is wrong. `name` is a file, or "-" for standard input. Throws
// std::runtime_error if it cannot be opened, or is no capture.
CaptureEnd readCapture(const std::string &name, const Overrules &overrules, WireDecoder &decoder);

}  // namespace line
