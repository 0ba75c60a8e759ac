// Futaba's sensors by their names, and what they measure as text.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sbus/Sensors.h"

namespace line {

struct Quantity {
  uint8_t slot;      // the one beside which it is shown, counted from the sensor's first
  const char *name;  // "current"
  std::string value;
  const char *unit;  // "A"; "" for none
};

struct Sensor {
  const char *name;  // as the radio and the shop call it
  uint8_t slots;
  std::vector<Quantity> (*quantities)(const sbus::SlotData *data);
};

// Returns all known sensors.
const std::vector<Sensor> &sensors();

// Returns the sensor of this name, in upper or lower case; nullptr if no sensor has it.
const Sensor *sensorOf(std::string_view name);

}  // namespace line
