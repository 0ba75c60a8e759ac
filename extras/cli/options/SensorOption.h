// --sensor SLOT=NAME: the sensor in a telemetry slot.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cli/options/Subcommand.h"
#include "line/telemetry/Readings.h"

namespace tool {

class SensorOption {
 public:
  explicit SensorOption(Subcommand &subcommand);

  // Returns the named sensors, and the receiver in slot 0. Rejects the command line if a sensor is unknown or does not
  // fit into its group of slots.
  line::SensorsBySlot sensors() const;

 private:
  std::vector<std::string> _named;
};

}  // namespace tool
