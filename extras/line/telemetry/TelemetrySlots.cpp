#include "line/telemetry/TelemetrySlots.h"

#include <algorithm>

namespace line {

std::vector<TelemetrySlots::Slot> TelemetrySlots::put(const Stretch &stretch) {
  if (stretch.kind == Stretch::Kind::NoFrame) {
    _between.insert(_between.end(), stretch.characters.begin(), stretch.characters.end());
    _isWhole = _isWhole && _between.size() <= sbus::GroupSizeMax &&
               std::none_of(stretch.characters.begin(), stretch.characters.end(),
                            [](const Character &character) { return character.bad; });
    if (!_isWhole) {
      _between.clear();
    }
    return {};
  }
  std::vector<Slot> found;
  if (stretch.kind == Stretch::Kind::Frame) {
    found = proved();
    _end = stretch.characters.back().value;
  }
  _isWhole = stretch.kind == Stretch::Kind::Frame;
  _between.clear();
  return found;
}

std::vector<TelemetrySlots::Slot> TelemetrySlots::proved() {
  if (!sbus::announcesSlots(_end)) {
    return {};
  }
  _announced = true;
  uint8_t bytes[sbus::GroupSizeMax];
  std::transform(_between.begin(), _between.end(), bytes, [](const Character &character) { return character.value; });
  sbus::Slot slots[sbus::SlotsOfGroup];
  const int count = _isWhole ? sbus::readSlots(_end, bytes, static_cast<uint8_t>(_between.size()), slots) : -1;
  _rejected += count < 0;
  std::vector<Slot> found;
  for (int i = 0; i < count; i++) {
    // The slots end with the last character, but for the 00 that an R7003SB adds.
    const size_t tail = _between.size() % sbus::SlotSize != 0;
    const size_t last = tail + (static_cast<size_t>(i) + 1) * sbus::SlotSize - 1;
    found.push_back({slots[i], _between[last].endUs});
  }
  return found;
}

}  // namespace line
