#include "line/telemetry/Readings.h"

#include <cstdlib>

namespace line {

std::vector<Quantity> quantitiesIn(const std::vector<TimedSlot> &slots, const SensorsBySlot &sensors) {
  std::vector<Quantity> found;
  for (size_t first = 0; first < slots.size(); first++) {
    const uint8_t number = slots[first].number;
    const auto sensor = sensors.find(number);
    const size_t count = sensor == sensors.end() ? 0 : sensor->second->slots;
    if (count == 0 || first + count > slots.size() || slots[first + count - 1].number != number + count - 1) {
      continue;
    }
    std::vector<sbus::SlotData> data;
    for (size_t i = 0; i < count; i++) {
      data.push_back(slots[first + i].data);
    }
    for (Quantity &quantity : sensor->second->quantities(data.data())) {
      quantity.slot = static_cast<uint8_t>(number + quantity.slot);
      found.push_back(std::move(quantity));
    }
  }
  return found;
}

void Readings::put(const std::vector<TimedSlot> &slots) {
  for (const TimedSlot &slot : slots) {
    _slots[slot.number] = slot.endUs;
  }
  for (const Quantity &quantity : quantitiesIn(slots, _sensors)) {
    _readings[{quantity.slot, quantity.name}] = {quantity, std::strtod(quantity.value.c_str(), nullptr),
                                                 slots.back().endUs};
  }
}

std::vector<std::string> Readings::quantities(uint64_t sinceUs) const {
  std::vector<std::string> texts;
  each(sinceUs, [&texts](const Quantity &quantity, double) {
    texts.push_back(quantity.name + (' ' + quantity.value) + ' ' + quantity.unit);
  });
  return texts;
}

std::string Readings::slots(uint64_t sinceUs) const {
  std::string numbers;
  size_t count = 0;
  for (const auto &[number, endUs] : _slots) {
    if (endUs >= sinceUs) {
      numbers += (count++ == 0 ? "" : ", ") + std::to_string(number);
    }
  }
  return count == 0 ? "" : (count == 1 ? "slot " : "slots ") + numbers;
}

}  // namespace line
