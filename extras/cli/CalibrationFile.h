// The file that `sbus calibrate` writes and `sbus joystick` reads: each channel's raw values at -100, 0 and +100 %.
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

// Returns the file's text, without uncalibrated channels.
std::string calibrationText(const sbus::Calibration &calibration);

// Reads the file; channels that it does not name keep their ranges. Throws std::runtime_error with file and line.
void readCalibration(const std::string &name, ChannelRanges &ranges);

}  // namespace tool
