// The simulated receiver at a port that the page may set wrong, on a wire that it may cut.
#pragma once

#include <memory>

#include "line/Line.h"
#include "line/LineSettings.h"
#include "line/simulation/SimulatedReceiver.h"
#include "line/uart/UartSampler.h"

namespace scope {

class SimulatedLine : public line::Line {
 public:
  // `noise`: disturbances a second. The port is set as the line is.
  SimulatedLine(line::Sticks sticks, line::Channels channels, unsigned noise, const line::LineSettings &settings);

  // Opens the port again.
  void setPort(uint64_t nowUs, const line::LineSettings &port) { _sampler.open(nowUs, port, _settings); }

  // Nothing arrives while the wire is cut.
  void cut(bool cut) { _cut = cut; }

  bool next(uint64_t nowUs, line::Character &character) override;

 private:
  const line::LineSettings _settings;
  std::unique_ptr<line::Line> _line;
  line::UartSampler _sampler;
  bool _cut = false;
  uint64_t _knownUs = 0;  // all characters complete by then have been put
};

}  // namespace scope
