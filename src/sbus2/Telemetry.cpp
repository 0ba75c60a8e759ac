#include "Telemetry.h"

#include <string.h>

#include "../sbus/Barrier.h"

namespace sbus {

namespace {

constexpr uint8_t FramePeriod = 15;  // ms, of S.BUS2
constexpr uint32_t FrameUs = FramePeriod * 1000UL;
constexpr uint32_t RoundUs = 4 * FrameUs;
// Characters between a frame and the next but one: two groups, and a frame that lacks at least one.
constexpr uint8_t BeforeNextMax = 2 * GroupSizeMax + FrameSize - 1;

// Returns the end byte that follows this one: 04, 14, 24, 34, 04.
constexpr uint8_t nextEnd(uint8_t end) { return static_cast<uint8_t>((end + 0x10) & 0x3F); }

}  // namespace

void Telemetry::begin() {
  forgetAll();
  _count = 0;
  _end = 0;
  _rejected = 0;
  _breaks = 0;
  memset(_joined, 0, sizeof _joined);
}

void Telemetry::forgetAll() {
  memset(_seen, Old, sizeof _seen);
  _changes++;
}

// The data may change while they are copied: then they are copied again.
bool Telemetry::read(uint8_t first, uint8_t count, SlotData *data) {
  if (first + count > SlotCount) {
    return false;
  }
  for (uint8_t slot = first; slot + 1 < first + count; slot++) {
    uint8_t &joined = _joined[slot / SlotsOfGroup];
    joined = static_cast<uint8_t>(joined | 1 << slot % SlotsOfGroup);
  }
  uint16_t changes;
  do {
    changes = _changes;
    barrier();
    for (uint8_t i = 0; i < count; i++) {
      if (misses(first + i) > MissesMax || misses(first + i) != misses(first)) {
        return false;
      }
    }
    memcpy(data, _data + first, count * sizeof *data);
    barrier();
  } while (changes != _changes);
  return true;
}

bool Telemetry::read(uint8_t first, uint8_t count, SlotData *data, Trust &trust) {
  uint16_t changes;
  do {
    changes = _changes;
    barrier();
    if (!read(first, count, data)) {
      return false;
    }
    // The frame that announced them: 1 to 4 frames ago, and a round for each miss.
    const uint8_t frames = static_cast<uint8_t>(((_end >> 4) - first / SlotsOfGroup - 1) & 3);
    trust.age = static_cast<uint16_t>(FramePeriod * (4 * misses(first) + frames + 1));
    trust.times = UINT8_MAX;
    for (uint8_t i = 0; i < count; i++) {
      const uint8_t times = static_cast<uint8_t>(_seen[first + i] / Time + 1);
      trust.times = times < trust.times ? times : trust.times;
    }
    barrier();
  } while (changes != _changes);
  return true;
}

bool Telemetry::takeEcho(uint8_t slot, SlotData &data) {
  if (misses(slot) != 0) {
    return false;
  }
  data = _data[slot];
  _seen[slot] = Old;
  return true;
}

void Telemetry::discarded(const uint8_t *bytes, int count) {
  const int room = static_cast<int>(sizeof _characters) - _count;
  if (room > 0) {
    memcpy(_characters + _count, bytes, static_cast<size_t>(count < room ? count : room));
  }
  _count = static_cast<uint8_t>(count < Lost - _count ? _count + count : Lost);
}

void Telemetry::put(uint8_t slot, const SlotData &data) {
  SlotData &mine = _data[slot];
  const bool isSame = misses(slot) <= MissesMax && mine.data0 == data.data0 && mine.data1 == data.data1;
  mine = data;
  const uint8_t times = _seen[slot] & TimesMax;
  _seen[slot] = !isSame ? uint8_t{0} : times < TimesMax ? static_cast<uint8_t>(times + Time) : times;
}

// Counts a round of a group. Returns which of its slots come on this line.
uint8_t Telemetry::countRound(uint8_t first) {
  uint8_t expected = 0;
  for (uint8_t i = 0; i < SlotsOfGroup; i++) {
    if (misses(first + i) <= MissesMax) {
      _seen[first + i]++;
      expected = static_cast<uint8_t>(expected | 1 << i);
    } else {
      _breaks &= ~(uint32_t{1} << (first + i));  // it may be another receiver by now
    }
  }
  return expected;
}

// Finds the slots before the next frame, and writes their data. `expected`: which come on this line. Returns false if
// the characters are not just slots.
bool Telemetry::findAll(uint8_t &found, SlotData *data, uint8_t &expected) {
  found = 0;
  if (!announcesSlots(_end)) {
    return true;
  }
  expected = countRound(firstSlotOf(_end));
  Slot slots[SlotsOfGroup];
  const int8_t count = _count > GroupSizeMax ? int8_t{-1} : readSlots(_end, _characters, _count, slots, _breaks);
  for (int8_t i = 0; i < count; i++) {
    const uint8_t k = slots[i].number % SlotsOfGroup;
    found = static_cast<uint8_t>(found | 1 << k);
    data[k] = slots[i].data;
  }
  _rejected += count < 0;
  return count >= 0;
}

// Finds the slots that are whole nevertheless. Only one frame may be missing after the group: otherwise its data would
// be older than they seem.
uint8_t Telemetry::findSome(uint8_t newest, SlotData *data, uint8_t expected) const {
  const bool isNextLost = newest == nextEnd(nextEnd(_end));
  if (_count > (isNextLost ? BeforeNextMax : GroupSizeMax)) {
    return 0;
  }
  const uint8_t count = _count < sizeof _characters ? _count : static_cast<uint8_t>(sizeof _characters);
  return wholeSlots(_end, isNextLost, _characters, count, expected, static_cast<uint8_t>(_breaks >> firstSlotOf(_end)),
                    data);
}

// Keeps the data that were found. Slots that are read together change together.
void Telemetry::keep(uint8_t found, const SlotData *data) {
  const uint8_t first = firstSlotOf(_end);
  const uint8_t joined = _joined[first / SlotsOfGroup] & 0x7F;
  if (joined != 0) {
    for (uint8_t i = 1; i < SlotsOfGroup; i++) {
      found = static_cast<uint8_t>(found & ~(joined & ~(found >> 1)));
      found = static_cast<uint8_t>(found & ~((joined & ~found) << 1));
    }
  }
  for (uint8_t k = 0; found != 0; k++, found = static_cast<uint8_t>(found >> 1)) {
    if ((found & 1) != 0) {
      put(static_cast<uint8_t>(first + k), data[k]);
    }
  }
}

// End bytes tell how many frames are missing, but four more look alike: the time tells them. It may be negative, if a
// blocked loop() has hidden when the frame before came.
void Telemetry::countRounds(uint8_t frames) {
  constexpr uint32_t Negative = UINT32_MAX - 1000000;
  uint8_t rounds = 0;
  for (uint32_t us = (frames + 2) * FrameUs; _interval >= us && _interval < Negative && rounds < Old; us += RoundUs) {
    rounds++;
  }
  for (; rounds > 0; rounds--) {
    for (uint8_t first = 0; first < SlotCount; first = static_cast<uint8_t>(first + SlotsOfGroup)) {
      countRound(first);
    }
  }
}

// Counts the rounds of groups whose frames are missing, and begins the next one.
void Telemetry::next(uint8_t newest) {
  uint8_t frames = 1;  // from the one before to the newest
  if (endsVariant(_end, SlotsVariant) && endsVariant(newest, SlotsVariant)) {
    for (uint8_t end = nextEnd(_end); end != newest; end = nextEnd(end)) {
      countRound(firstSlotOf(end));
      frames++;
    }
  }
  countRounds(frames);
  _changes++;
  _end = newest;
  _count = 0;
}

// A slot that lost its ID may look like one that is not on the line, in the place of one that is.
void Telemetry::accepted(const uint8_t *frame) {
  SlotData data[SlotsOfGroup];
  uint8_t found, expected = 0;
  const bool areSlots = findAll(found, data, expected);
  const bool isOdd = areSlots && (found & ~expected) != 0 && (expected & ~found) != 0;
  _rejected += isOdd;
  if (!areSlots || isOdd) {
    found = findSome(frame[EndIndex], data, expected);
  }
  keep(found, data);
  next(frame[EndIndex]);
}

void Telemetry::acceptWhole(const uint8_t *frame) {
  SlotData data[SlotsOfGroup];
  uint8_t found, expected;
  findAll(found, data, expected);
  keep(found, data);
  next(frame[EndIndex]);
}

}  // namespace sbus
