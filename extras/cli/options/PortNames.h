// The names of this PC's serial ports.
#pragma once

#include <string>
#include <vector>

namespace tool {

// Returns "/dev/ttyUSB0" and the like; nothing if the system does not list its ports.
std::vector<std::string> portNames();

}  // namespace tool
