// --sensor SLOT=NAME: the sensor in a telemetry slot.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "cli/options/Subcommand.h"
#include "line/Format.h"
#include "line/recording/Words.h"
#include "line/telemetry/Readings.h"

namespace tool {

class SensorOption {
 public:
  explicit SensorOption(Subcommand &subcommand) {
    subcommand.option("--sensor", _named, "the sensor in a telemetry slot, such as 1=SBS-01V; once for each sensor")
        .type("SLOT=NAME");
  }

  // Returns the named sensors, and the receiver in slot 0. Rejects the command line if a sensor is unknown or does not
  // fit into its group of slots.
  line::SensorsBySlot sensors() const {
    line::SensorsBySlot sensors = {{uint8_t{0}, line::sensorOf("receiver")}};
    for (const std::string &text : _named) {
      addSensor(text, sensors);
    }
    return sensors;
  }

 private:
  static std::string knownNames() {
    std::string names;
    for (const line::Sensor &sensor : line::sensors()) {
      names += (names.empty() ? "" : ", ") + std::string(sensor.name);
    }
    return names;
  }

  // Adds "1=SBS-01V". A sensor's slots follow one another within a group of eight.
  static void addSensor(const std::string &text, line::SensorsBySlot &sensors) {
    const size_t equals = text.find('=');
    uint8_t slot = 0;
    if (equals == std::string::npos || equals > 2 || !line::parseWhole(text.substr(0, equals), slot) ||
        slot >= sbus::SlotCount) {
      rejectCommandLine("--sensor: " + text + " is not a slot and name, such as 1=SBS-01V; slots are 0 to 31");
    }
    const line::Sensor *const sensor = line::sensorOf(text.substr(equals + 1));
    if (sensor == nullptr) {
      rejectCommandLine("--sensor: " + text + " is not a known sensor; these are: " + knownNames());
    }
    if (slot % sbus::SlotsOfGroup + sensor->slots > sbus::SlotsOfGroup) {
      rejectCommandLine(
          line::format("--sensor: %s has %u slots, which do not fit into the group of slots %u to %u from slot %u on",
                       sensor->name, sensor->slots, slot / 8 * 8, slot / 8 * 8 + 7, slot));
    }
    for (const auto &[first, other] : sensors) {
      const bool isSame = first == slot && other == sensor;
      if (!isSame && slot < first + other->slots && first < slot + sensor->slots) {
        rejectCommandLine(line::format("--sensor: %s: slot %u is a slot of %s", text.c_str(),
                                       std::max<unsigned>(slot, first), other->name));
      }
    }
    sensors[slot] = sensor;
  }

  std::vector<std::string> _named;
};

}  // namespace tool
