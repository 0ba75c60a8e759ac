#include "Slots.h"

namespace sbus {

namespace {

// An R7003SB sends a 00 before its slot and one after it: the line's break, github.com/bolderflight/sbus/issues/79.
bool isTail(uint8_t end, const uint8_t *characters, uint8_t count) {
  return endsVariant(end, TailVariant) && count == LineVariants[TailVariant].tailSize && characters[0] == 0 &&
         characters[count - 1] == 0;
}

}  // namespace

int8_t readSlots(uint8_t end, const uint8_t *characters, uint8_t count, Slot *slots) {
  if (isTail(end, characters, count)) {
    characters++;
    count = static_cast<uint8_t>(count - 2);
  }
  if (!announcesSlots(end) || count % SlotSize != 0 || count > SlotSize * SlotsOfGroup) {
    return -1;
  }
  uint8_t next = firstSlotOf(end);  // the lowest slot that may follow
  const uint8_t behind = static_cast<uint8_t>(next + (endsVariant(end, TailVariant) ? 1 : SlotsOfGroup));
  int8_t found = 0;
  for (uint8_t at = 0; at < count; at = static_cast<uint8_t>(at + SlotSize)) {
    const uint8_t number = slotOfId(characters[at]);
    if (!isSlotId(characters[at]) || number < next || number >= behind) {
      return -1;
    }
    slots[found++] = {number, {characters[at + 1], characters[at + 2]}};
    next = static_cast<uint8_t>(number + 1);
  }
  return found;
}

}  // namespace sbus
