#include "line/telemetry/TelemetrySlots.h"

#include <algorithm>

namespace line {

namespace {

bool isGood(const std::vector<Character> &characters) {
  return std::none_of(characters.begin(), characters.end(), [](const Character &each) { return each.bad; });
}

// Returns the index of the last character of each whole slot. A break, 00, may precede and follow each.
std::vector<size_t> endsOf(const std::vector<Character> &characters) {
  std::vector<size_t> ends;
  for (size_t at = 0; at + sbus::SlotSize <= characters.size();) {
    if (characters[at].value == 0) {
      at++;
    } else {
      at += sbus::SlotSize;
      ends.push_back(at - 1);
    }
  }
  return ends;
}

// Returns the slots `from` to `to` of these characters, with their times.
std::vector<TimedSlot> timed(const sbus::Slot *slots, int from, int to, const std::vector<Character> &characters) {
  const std::vector<size_t> ends = endsOf(characters);
  std::vector<TimedSlot> found;
  for (int i = from; i < to; i++) {
    found.push_back({slots[i], characters[ends[static_cast<size_t>(i)]].endUs});
  }
  return found;
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
    takeProved();
    _end = stretch.characters.back().value;
  }
  _isWhole = stretch.kind == Stretch::Kind::Frame;
  _between.clear();
}

void TelemetrySlots::takeProved() {
  _proved = prove();
  _count += _proved.size();
  _characters += _proved.empty() ? 0 : _between.size();
}

void TelemetrySlots::finish() {
  _proved.clear();
  sbus::Slot slots[sbus::SlotsOfGroup];
  uint32_t breaks = 0;
  if (_isWhole && read(_between, slots, breaks) > 0) {
    takeProved();
  }
  _between.clear();
}

std::vector<TimedSlot> TelemetrySlots::slotsIn(const Stretch &stretch) const {
  std::vector<Character> all = _between;
  all.insert(all.end(), stretch.characters.begin(), stretch.characters.end());
  if (!_isWhole || all.size() > sbus::GroupSizeMax || !isGood(stretch.characters)) {
    return {};
  }
  sbus::Slot slots[sbus::SlotsOfGroup];
  uint32_t breaks = 0;  // a break may still come
  const int count = read(all, slots, breaks);
  const int before = static_cast<int>(endsOf(_between).size());
  return timed(slots, before, count, all);
}

unsigned long TelemetrySlots::characters() const {
  sbus::Slot slots[sbus::SlotsOfGroup];
  uint32_t breaks = 0;  // one may still come
  return _characters + (_isWhole && read(_between, slots, breaks) > 0 ? _between.size() : 0);
}

// Returns the number of slots in these characters, at most a group; -1 if they are not slots.
int TelemetrySlots::read(const std::vector<Character> &characters, sbus::Slot *slots, uint32_t &breaks) const {
  uint8_t bytes[sbus::GroupSizeMax];
  std::transform(characters.begin(), characters.end(), bytes, [](const Character &each) { return each.value; });
  return sbus::readSlots(_end, bytes, static_cast<uint8_t>(characters.size()), slots, breaks);
}

std::vector<TimedSlot> TelemetrySlots::prove() {
  if (!sbus::announcesSlots(_end)) {
    return {};
  }
  _announced = true;
  sbus::Slot slots[sbus::SlotsOfGroup];
  const int count = _isWhole ? read(_between, slots, _breaks) : -1;
  _groups += count > 0;
  _rejected += count < 0;
  _rejectedInRow = count < 0 ? _rejectedInRow + 1 : count > 0 ? 0 : _rejectedInRow;
  if (_rejectedInRow == MostRejected) {
    _breaks = 0;  // this may be another receiver
  }
  return timed(slots, 0, count, _between);
}

}  // namespace line
