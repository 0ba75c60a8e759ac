#include "cli/CalibrationFile.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "line/Format.h"

namespace tool {

namespace {

const char Remedy[] = "; sbus calibrate writes such a file";

// Reads one line, without its comment. Returns false if it is wrong.
bool takeLine(const std::string &line, ChannelRanges &ranges, unsigned &named) {
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

}  // namespace

std::string calibrationText(const sbus::Calibration &calibration) {
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

void readCalibration(const std::string &name, ChannelRanges &ranges) {
  std::ifstream in(name);
  if (!in) {
    throw std::runtime_error(name + ": " + std::strerror(errno) + Remedy);
  }
  std::string line;
  unsigned named = 0;
  for (unsigned number = 1; std::getline(in, line); number++) {
    line.erase(std::min(line.find('#'), line.size()));
    if (line.find_first_not_of(" \t\r") != std::string::npos && !takeLine(line, ranges, named)) {
      throw std::runtime_error(line::format(
          "%s:%u: a channel's raw values at -100, 0 and +100 %% are expected, such as CH1 172 992 1811, with each "
          "channel of CH1 to CH16 at most once",
          name.c_str(), number));
    }
  }
  if (named == 0) {
    throw std::runtime_error(name + ": no channels" + Remedy);
  }
}

}  // namespace tool
