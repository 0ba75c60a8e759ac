// The file that `sbus calibrate` writes and `sbus joystick` reads: which raw values are -100, 0 and +100 % of each
// channel.
//
//   # any comment
//   CH1 172 992 1811
//   CH2 1790 1002 200     # reversed
#pragma once

#include <array>
#include <string>

#include "sbus/Calibration.h"

namespace tool {

using ChannelRanges = std::array<sbus::Range, 32>;  // CH1..CH32

// Returns the file's text. Channels that are not calibrated are left out.
std::string calibrationText(const sbus::Calibration &calibration);

// Reads the file into the channels that it names. Throws std::runtime_error, which names file and line.
void readCalibration(const std::string &name, ChannelRanges &ranges);

}  // namespace tool
