// Reads captures in files.
#pragma once

#include <string>

#include "line/capture/CaptureText.h"

namespace line {

// Reads a capture to its end, or up to an error. `path` is a file, or "-" for standard input; messages call it `name`.
// Throws std::runtime_error if it cannot be opened or is not a capture.
CaptureEnd readCapture(const std::string &path, const std::string &name, const Overrides &overrides,
                       WireDecoder &decoder);

}  // namespace line
