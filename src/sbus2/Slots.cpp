#include "Slots.h"

namespace sbus {

int8_t readSlots(uint8_t end, const uint8_t *characters, uint8_t count, Slot *slots, uint32_t &breaks) {
  if (!announcesSlots(end)) {
    return -1;
  }
  uint8_t next = firstSlotOf(end);  // the lowest slot that may follow
  const uint8_t limit = static_cast<uint8_t>(next + (endsVariant(end, TailVariant) ? 1 : SlotsOfGroup));
  const uint8_t *const after = characters + count;
  if (count != 0 && *characters == 0) {
    characters++;  // the break of the frame
  }
  uint32_t seen = breaks;
  int8_t found = 0;
  while (characters < after) {
    const uint8_t number = slotOfId(characters[0]);
    if (!isSlotId(characters[0]) || number < next || number >= limit || after - characters < SlotSize) {
      return -1;
    }
    slots[found++] = {number, {characters[1], characters[2]}};
    characters += SlotSize;
    const uint32_t bit = uint32_t{1} << number;
    if (characters < after && *characters == 0) {
      seen |= bit;
      characters++;
    } else if ((breaks & bit) != 0) {
      return -1;  // it may have lost a character, and taken the break for data
    }
    next = static_cast<uint8_t>(number + 1);
  }
  breaks = seen;
  return found;
}

// A slot that has lost a character takes the next one's ID for data; from the other end, its own.
uint8_t wholeSlots(uint8_t end, bool isOpen, const uint8_t *characters, uint8_t count, uint8_t expected, uint8_t breaks,
                   SlotData *data) {
  const uint8_t first = firstSlotOf(end);
  const uint8_t *const stop = characters + count;
  const auto sizeOf = [breaks](uint8_t k) -> uint8_t { return (breaks >> k & 1) != 0 ? SlotSize + 1 : SlotSize; };
  const auto isId = [&](const uint8_t *at, uint8_t k) {
    return at < stop && at[0] == slotId(static_cast<uint8_t>(first + k));
  };
  const auto isComplete = [&](const uint8_t *at, uint8_t k) {
    const uint8_t size = sizeOf(k);
    return stop - at >= size && (size == SlotSize || at[SlotSize] == 0);
  };

  // From the beginning on: each slot that the next one follows where it should.
  uint8_t whole = 0, last = 0;
  const uint8_t *at = characters[0] == 0 ? characters + 1 : characters;  // after the frame's break
  SlotData before = {0, 0};
  uint8_t k = 0;
  for (; k < SlotsOfGroup; k++) {
    if ((expected >> k & 1) == 0) {
      continue;
    }
    if (!isId(at, k) || before.data0 == at[0] || before.data1 == at[0]) {
      break;
    }
    whole |= last;
    last = 0;
    if (!isComplete(at, k)) {
      break;
    }
    last = static_cast<uint8_t>(1 << k);
    before = {at[1], at[2]};
    data[k] = before;
    at += sizeOf(k);
  }
  if (isOpen) {
    const bool isLast = k == SlotsOfGroup && at < stop && at[0] == HeaderByte && before.data1 != HeaderByte;
    return isLast ? whole | last : whole;
  }
  // From the end on.
  at = stop;
  for (k = SlotsOfGroup; k-- > 0;) {
    if ((expected >> k & 1) == 0) {
      continue;
    }
    if (at - characters < sizeOf(k)) {
      break;
    }
    at -= sizeOf(k);
    if (!isId(at, k) || !isComplete(at, k) || at[1] == at[0] || (at > characters && at[-1] == at[0])) {
      break;
    }
    whole = static_cast<uint8_t>(whole | 1 << k);
    data[k] = {at[1], at[2]};
  }
  return whole;
}

}  // namespace sbus
