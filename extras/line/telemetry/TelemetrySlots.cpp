#include "line/telemetry/TelemetrySlots.h"

#include <algorithm>

namespace line {

namespace {

bool isGood(const std::vector<Character> &characters) {
  return std::none_of(characters.begin(), characters.end(), [](const Character &each) { return each.bad; });
}

// Returns how many slots these characters are, at most a group; -1 if they are not slots.
int readSlots(uint8_t end, const std::vector<Character> &characters, sbus::Slot *slots) {
  uint8_t bytes[sbus::GroupSizeMax];
  std::transform(characters.begin(), characters.end(), bytes, [](const Character &each) { return each.value; });
  return sbus::readSlots(end, bytes, static_cast<uint8_t>(characters.size()), slots);
}

}  // namespace

void TelemetrySlots::put(const Stretch &stretch) {
  _proved.clear();
  if (stretch.kind == Stretch::Kind::NoFrame) {
    _between.insert(_between.end(), stretch.characters.begin(), stretch.characters.end());
    _isWhole = _isWhole && _between.size() <= sbus::GroupSizeMax && isGood(stretch.characters);
    if (!_isWhole) {
      _between.clear();
    }
    return;
  }
  if (stretch.kind == Stretch::Kind::Frame) {
    _proved = prove();
    _count += _proved.size();
    _characters += _proved.empty() ? 0 : _between.size();
    _end = stretch.characters.back().value;
  }
  _isWhole = stretch.kind == Stretch::Kind::Frame;
  _between.clear();
}

std::vector<sbus::Slot> TelemetrySlots::slotsIn(const Stretch &stretch) const {
  std::vector<Character> all = _between;
  all.insert(all.end(), stretch.characters.begin(), stretch.characters.end());
  if (!_isWhole || all.size() > sbus::GroupSizeMax || !isGood(stretch.characters)) {
    return {};
  }
  sbus::Slot slots[sbus::SlotsOfGroup];
  const int count = readSlots(_end, all, slots);
  const int before = static_cast<int>(_between.size() / sbus::SlotSize);
  return count <= before ? std::vector<sbus::Slot>() : std::vector<sbus::Slot>(slots + before, slots + count);
}

unsigned long TelemetrySlots::characters() const {
  sbus::Slot slots[sbus::SlotsOfGroup];
  return _characters + (_isWhole && readSlots(_end, _between, slots) > 0 ? _between.size() : 0);
}

std::vector<TelemetrySlots::Slot> TelemetrySlots::prove() {
  if (!sbus::announcesSlots(_end)) {
    return {};
  }
  _announced = true;
  sbus::Slot slots[sbus::SlotsOfGroup];
  const int count = _isWhole ? readSlots(_end, _between, slots) : -1;
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
