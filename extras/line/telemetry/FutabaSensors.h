// Futaba's sensors by name, and their measurements as text.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sbus2/Sensors.h"

namespace line {

struct Quantity {
  uint8_t slot;      // it is shown next to this slot, counted from the sensor's first
  const char *name;  // "current"
  std::string value;
  const char *unit;  // "A"; "" for none
};

struct Sensor {
  const char *name;  // used by the radio and in shops
  uint8_t slots;
  std::vector<Quantity> (*quantities)(const sbus::SlotData *data);
};

// Returns all known sensors.
const std::vector<Sensor> &sensors();

// Returns the sensor with this name, in upper or lower case; nullptr for an unknown name.
const Sensor *sensorOf(std::string_view name);

}  // namespace line
