// The file that `sbus calibrate` writes and `sbus joystick` reads: each channel's raw values at -100, 0 and +100 %.
//
//   # any comment
//   CH1 172 992 1811
//   CH2 1790 1002 200     # reversed
#pragma once

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>

#include "line/Format.h"
#include "sbus/Calibration.h"

namespace tool {

using ChannelRanges = std::array<sbus::Range, 32>;  // CH1..CH32

constexpr const char *CalibrationRemedy = "; sbus calibrate writes such a file";

// Reads one line, without its comment. Returns false if it is wrong.
inline bool takeCalibrationLine(const std::string &line, ChannelRanges &ranges, unsigned &named) {
  unsigned channel = 0, low = 0, centre = 0, high = 0;
  char more = 0;
  if (std::sscanf(line.c_str(), " CH%2u %4u %4u %4u %c", &channel, &low, &centre, &high, &more) != 4 || channel < 1 ||
      channel > sbus::ProportionalCount || (named >> channel & 1) != 0) {
    return false;
  }
  const sbus::Range range = {static_cast<uint16_t>(low), static_cast<uint16_t>(centre), static_cast<uint16_t>(high)};
  const sbus::CalibratedChannel calibrated = {range, 0};
  if (!sbus::isCalibrated(calibrated) || !sbus::isPossible(calibrated)) {
    return false;
  }
  ranges[channel - 1] = range;
  named |= 1U << channel;
  return true;
}

// Returns the file's text, without uncalibrated channels.
inline std::string calibrationText(const sbus::Calibration &calibration) {
  std::string text = "# sbus calibrate: raw values at -100, 0 and +100 %\n";
  unsigned number = 0;
  for (const sbus::CalibratedChannel &channel : calibration.channels) {
    number++;
    if (sbus::isCalibrated(channel)) {
      text += line::format("CH%u %u %u %u\n", number, channel.range.low, channel.range.centre, channel.range.high);
    }
  }
  return text;
}

// Reads the file; channels that it does not name keep their ranges. Throws std::runtime_error with file and line.
inline void readCalibration(const std::string &name, ChannelRanges &ranges) {
  std::ifstream in(name);
  if (!in) {
    throw std::runtime_error(name + ": " + std::strerror(errno) + CalibrationRemedy);
  }
  std::string line;
  unsigned named = 0;
  for (unsigned number = 1; std::getline(in, line); number++) {
    line.erase(std::min(line.find('#'), line.size()));
    if (line.find_first_not_of(" \t\r") != std::string::npos && !takeCalibrationLine(line, ranges, named)) {
      throw std::runtime_error(line::format(
          "%s:%u: a channel's raw values at -100, 0 and +100 %% are expected, such as CH1 172 992 1811, with each "
          "channel of CH1 to CH16 at most once",
          name.c_str(), number));
    }
  }
  if (named == 0) {
    throw std::runtime_error(name + ": no channels" + CalibrationRemedy);
  }
}

}  // namespace tool
