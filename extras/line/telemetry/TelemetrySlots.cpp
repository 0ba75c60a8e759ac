#include "line/telemetry/TelemetrySlots.h"

#include <algorithm>

namespace line {

namespace {

bool isGood(const std::vector<Character> &characters) {
  return std::none_of(characters.begin(), characters.end(), [](const Character &each) { return each.bad; });
}

// Returns the index of the last character of each whole slot. A break, 00, may stand before and after each.
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

// Us. Of an S.BUS2 slot, and of slot 0 behind end byte 08: src/sbus/Answers.h, and captures of an R7003SB.
constexpr uint64_t ToSlots = 2030, ToTail = 310, Pitch = 660;
constexpr uint64_t Off = 100;   // how far from its time a sensor may begin
constexpr uint64_t Apart = 90;  // the least silence before a slot, and behind it and its break
constexpr uint64_t SlotsTime = ToSlots + sbus::SlotsOfGroup * Pitch;

uint64_t startOf(const Character &character) {
  return character.endUs - CharacterUs;
}

}  // namespace

void TelemetrySlots::put(const Stretch &stretch) {
  _proved.clear();
  if (stretch.kind == Stretch::Kind::NoFrame) {
    for (const Character &each : stretch.characters) {
      if (each.endUs < _endUs + SlotsTime) {
        _all.push_back(each);
      }
    }
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
  _endUs = stretch.kind == Stretch::Kind::Frame ? stretch.endUs() : 0;
  _all.clear();
  _isWhole = stretch.kind == Stretch::Kind::Frame;
  _between.clear();
}

void TelemetrySlots::takeProved() {
  _proved = prove();
  _count += _proved.size();
}

void TelemetrySlots::finish() {
  _proved.clear();
  sbus::Slot slots[sbus::SlotsOfGroup];
  uint32_t breaks = 0;
  if (_isWhole && read(_between, slots, breaks) > 0) {
    takeProved();
  }
  _between.clear();
  _all.clear();
}

std::vector<sbus::Slot> TelemetrySlots::slotsIn(const Stretch &stretch) const {
  std::vector<Character> all = _between;
  all.insert(all.end(), stretch.characters.begin(), stretch.characters.end());
  if (!_isWhole || all.size() > sbus::GroupSizeMax || !isGood(stretch.characters)) {
    return {};
  }
  sbus::Slot slots[sbus::SlotsOfGroup];
  uint32_t breaks = 0;  // a break may still come
  const int count = read(all, slots, breaks);
  const int before = static_cast<int>(endsOf(_between).size());
  return count <= before ? std::vector<sbus::Slot>() : std::vector<sbus::Slot>(slots + before, slots + count);
}

unsigned long TelemetrySlots::characters() const {
  sbus::Slot slots[sbus::SlotsOfGroup];
  uint32_t breaks = 0;  // one may still come
  return _characters + (_isWhole && read(_between, slots, breaks) > 0 ? _between.size() : 0);
}

// Returns how many slots these characters are, at most a group; -1 if they are not slots.
int TelemetrySlots::read(const std::vector<Character> &characters, sbus::Slot *slots, uint32_t &breaks) const {
  uint8_t bytes[sbus::GroupSizeMax];
  std::transform(characters.begin(), characters.end(), bytes, [](const Character &each) { return each.value; });
  return sbus::readSlots(_end, bytes, static_cast<uint8_t>(characters.size()), slots, breaks);
}

std::vector<TelemetrySlots::Slot> TelemetrySlots::prove() {
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
    _breaks = 0;  // it may be another receiver by now
  }
  const std::vector<size_t> ends = endsOf(_between);
  std::vector<Slot> found;
  if (count < 0) {
    found = onTime();
  }
  _characters += count < 0 ? found.size() * sbus::SlotSize : count > 0 ? _between.size() : 0;
  for (int i = 0; i < count; i++) {
    found.push_back({slots[i], _between[ends[static_cast<size_t>(i)]].endUs});
  }
  return found;
}

// Three good characters at the time of a slot of the announced group, between two pauses, are that slot. Only where the
// times are exact.
std::vector<TelemetrySlots::Slot> TelemetrySlots::onTime() const {
  const bool isTail = sbus::endsVariant(_end, sbus::TailVariant);
  const uint8_t first = sbus::firstSlotOf(_end);
  const int count = isTail ? 1 : sbus::SlotsOfGroup;
  std::vector<Slot> found;
  for (size_t i = 0; i + sbus::SlotSize <= _all.size(); i++) {
    const Character *const slot = &_all[i];
    const Character *const last = slot + sbus::SlotSize - 1;
    const Character *const behind = _all.data() + _all.size();
    const int k = sbus::slotOfId(slot->value) - first;
    if (!sbus::isSlotId(slot->value) || k < 0 || k >= count ||
        std::any_of(slot, last + 1, [](const Character &each) { return each.bad || each.lateUs > 0; })) {
      continue;
    }
    const uint64_t start = startOf(*slot);
    const uint64_t due = _endUs + (isTail ? ToTail : ToSlots + static_cast<uint64_t>(k) * Pitch);
    const uint64_t free = i == 0 ? _endUs : slot[-1].endUs;
    const Character *next = last + 1;
    next += next < behind && next->value == 0 ? 1 : 0;  // a break
    if (start + Off >= due && start <= due + Off && free + Apart <= start &&
        last->endUs <= start + 3 * CharacterUs + 1 && (next == behind || startOf(*next) >= next[-1].endUs + Apart)) {
      found.push_back({{static_cast<uint8_t>(first + k), {slot[1].value, slot[2].value}}, last->endUs});
    }
  }
  return found;
}

}  // namespace line
