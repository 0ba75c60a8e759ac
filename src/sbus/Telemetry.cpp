#include "Telemetry.h"

#include <string.h>

#include "Barrier.h"

namespace sbus {

void Telemetry::begin() {
  memset(_misses, MissesMax + 1, sizeof _misses);
  _count = 0;
  _end = 0;
  _rejected = 0;
  _breaks = 0;
}

// The data may change while they are copied: then they are copied again.
bool Telemetry::read(uint8_t first, uint8_t count, SlotData *data) const {
  if (first + count > SlotCount) {
    return false;
  }
  for (uint8_t i = 0; i < count; i++) {
    if (_misses[first + i] > MissesMax) {
      return false;
    }
  }
  uint16_t changes;
  do {
    changes = _changes;
    barrier();
    memcpy(data, _data + first, count * sizeof *data);
    barrier();
  } while (changes != _changes);
  return true;
}

bool Telemetry::forget(uint8_t slot, SlotData &data) {
  if (_misses[slot] != 0) {
    return false;
  }
  data = _data[slot];
  _misses[slot] = MissesMax + 1;
  return true;
}

void Telemetry::discarded(const uint8_t *bytes, int count) {
  if (count > GroupSizeMax - _count) {
    lost();
    return;
  }
  memcpy(_characters + _count, bytes, static_cast<size_t>(count));
  _count = static_cast<uint8_t>(_count + count);
}

void Telemetry::taken(const uint8_t *frame) {
  if (announcesSlots(_end)) {
    const uint8_t first = firstSlotOf(_end);
    for (uint8_t i = 0; i < SlotsOfGroup; i++) {
      uint8_t &misses = _misses[first + i];
      if (misses <= MissesMax) {
        misses++;
      } else {
        _breaks &= ~(uint32_t{1} << (first + i));  // it may be another receiver by now
      }
    }
    Slot slots[SlotsOfGroup];
    const int8_t found = _count > GroupSizeMax ? int8_t{-1} : readSlots(_end, _characters, _count, slots, _breaks);
    _rejected += found < 0;
    for (int8_t i = 0; i < found; i++) {
      _data[slots[i].number] = slots[i].data;
      _misses[slots[i].number] = 0;
    }
    _changes++;
  }
  _end = frame[EndIndex];
  _count = 0;
}

}  // namespace sbus
