#include "Slots.h"

namespace sbus {

int8_t readSlots(uint8_t end, const uint8_t *characters, uint8_t count, Slot *slots, uint32_t &breaks) {
  if (!announcesSlots(end)) {
    return -1;
  }
  uint8_t next = firstSlotOf(end);  // the lowest slot that may follow
  const uint8_t behind = static_cast<uint8_t>(next + (endsVariant(end, TailVariant) ? 1 : SlotsOfGroup));
  const uint8_t *const after = characters + count;
  if (count != 0 && *characters == 0) {
    characters++;  // the break of the frame
  }
  uint32_t seen = breaks;
  int8_t found = 0;
  while (characters < after) {
    const uint8_t number = slotOfId(characters[0]);
    if (!isSlotId(characters[0]) || number < next || number >= behind || after - characters < SlotSize) {
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

}  // namespace sbus
