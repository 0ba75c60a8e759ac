/// @file
/// The telemetry slots of an S.BUS2 line, which the receiver and its sensors send between two frames. Sensors.h decodes
/// their data, and Frame.h what the receiver has to know of them.
///
/// Sources: Futaba has not published the format. github.com/BrushlessPower/SBUS2-Telemetry, github.com/dgatf/msrc and
/// github.com/delamonpansie/jitel agree on everything here; PX4-Autopilot's test_data/sbus2_r7008SB.txt shows slot 0.
///
/// All functions may be called from any context.
#pragma once

#include <stdint.h>

#include "../sbus/Frame.h"

namespace sbus {

constexpr uint8_t SlotCount = 32;    ///< of a line: four groups of eight
constexpr uint8_t SlotsOfGroup = 8;  ///< after one frame

/// The data of a slot. Slots carry no sensor type: the user has to know it.
struct SlotData {
  uint8_t data0;  ///< sent first
  uint8_t data1;  ///< sent second
};

/// A slot and its data.
struct Slot {
  uint8_t number;  ///< 0..31; 0 is the receiver's own
  SlotData data;   ///< its two bytes
};

/// Returns the ID of slot `number`, 0..31: its number's five bits in reverse order, then 011.
constexpr uint8_t slotId(uint8_t number) {
  return static_cast<uint8_t>((number & 1) << 7 | (number & 2) << 5 | (number & 4) << 3 | (number & 8) << 1 |
                              (number & 16) >> 1 | 3);
}

/// Returns the number, 0..31, of the slot with this ID; undefined if isSlotId(id) is false.
constexpr uint8_t slotOfId(uint8_t id) {
  return static_cast<uint8_t>(id >> 7 | (id & 0x40) >> 5 | (id & 0x20) >> 3 | (id & 0x10) >> 1 | (id & 0x08) << 1);
}

/// Returns the first slot, 0, 8, 16 or 24, of the group that a frame with this end byte announces. After 04, 14, 24 and
/// 34 sensors answer; after 08 only the receiver's slot 0 follows.
constexpr uint8_t firstSlotOf(uint8_t end) {
  return endsVariant(end, SlotsVariant) ? static_cast<uint8_t>((end >> 4) * SlotsOfGroup) : uint8_t{0};
}

/// Returns true if slots may follow a frame with this end byte.
constexpr bool announcesSlots(uint8_t end) { return endsVariant(end, SlotsVariant) || endsVariant(end, TailVariant); }

/// Splits the `count` characters between a frame with this end byte and the next frame into `slots` (room for 8).
/// Returns how many there are; -1 if the characters are not just slots of the announced group in rising order. There is
/// no checksum and no other proof: if a character is missing or extra, all of them are rejected.
///
/// On some lines a break, 00, follows each transmission: the frame, and each slot (Futaba R7008SB, R7003SB:
/// github.com/bolderflight/sbus/issues/79). Bit k of `breaks`, 0 at first, says that a break has followed slot k. From
/// then on one must follow it: otherwise the slot may have lost a character and taken the break for data.
int8_t readSlots(uint8_t end, const uint8_t *characters, uint8_t count, Slot *slots, uint32_t &breaks);

/// Finds slots that are whole although readSlots() rejects the group's `count` characters, and writes their data to
/// `data` (bit k of the result: data[k] has slot k of the group). Bit k of `expected` and of `breaks` says that slot k
/// comes on this line, and that a break follows it. `isOpen`: the characters also hold a rejected frame, after the
/// group.
///
/// A slot is whole if it is at the place that the expected slots before it, or after it, leave for it, and the next
/// slot follows it. Missing or extra characters cost only the slots from the first to the last of them.
uint8_t wholeSlots(uint8_t end, bool isOpen, const uint8_t *characters, uint8_t count, uint8_t expected, uint8_t breaks,
                   SlotData *data);

}  // namespace sbus
