// Keeps the newest value of each quantity measured by the sensors of an S.BUS2 line.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "line/telemetry/FutabaSensors.h"
#include "line/telemetry/TelemetrySlots.h"

namespace line {

// The sensor that begins at each slot. The slot itself does not name it; slot 0 is the receiver's own.
using SensorsBySlot = std::map<uint8_t, const Sensor *>;

// Returns the sensors' quantities in slots of one moment, in rising order of Quantity::slot, which counts from the
// line's slot 0. A sensor with a missing slot has no values.
std::vector<Quantity> quantitiesIn(const std::vector<TimedSlot> &slots, const SensorsBySlot &sensors);

class Readings {
 public:
  static constexpr uint64_t FreshUs = 1000000;  // a slot comes every 60 ms: later, 16 of them are missing

  explicit Readings(SensorsBySlot sensors = {{uint8_t{0}, sensorOf("receiver")}}) : _sensors(std::move(sensors)) {}

  // Takes slots of one moment.
  void put(const std::vector<TimedSlot> &slots);

  // Return those received at `sinceUs` or later, in rising order of slots: "receiver voltage 4.6 V"; "slots 0, 1, 24".
  std::vector<std::string> quantities(uint64_t sinceUs) const;
  std::string slots(uint64_t sinceUs) const;  // empty without slots

  // Calls take(quantity, number) for each received at `sinceUs` or later, in rising order of slots.
  template <typename Take>
  void each(uint64_t sinceUs, Take take) const {
    for (const auto &[key, reading] : _readings) {
      if (reading.endUs >= sinceUs) {
        take(reading.quantity, reading.number);
      }
    }
  }

 private:
  struct Reading {
    Quantity quantity;
    double number;  // its value
    uint64_t endUs;
  };

  SensorsBySlot _sensors;
  std::map<uint8_t, uint64_t> _slots;                            // the time of each
  std::map<std::pair<uint8_t, std::string>, Reading> _readings;  // the receiver sends two quantities in turn
};

}  // namespace line
