// Reads captures in files.
#pragma once

#include <string>

#include "line/capture/CaptureText.h"

namespace line {

// Reads a capture to its end, or until something is wrong. `path` is a file, or "-" for standard input;
// `name` is what messages call it. Throws std::runtime_error if it cannot be opened, or is no capture.
CaptureEnd readCapture(const std::string &path, const std::string &name, const Overrules &overrules,
                       WireDecoder &decoder);

}  // namespace line
