/// @file
/// Keeps the newest telemetry of an S.BUS2 line, from the events of a FrameFinder.
#pragma once

#include <stdint.h>

#include "../sbus/FrameFinder.h"
#include "Slots.h"

namespace sbus {

/// How far the data of some slots can be trusted: Telemetry::read().
struct Trust {
  uint16_t age;   ///< ms, at the newest frame for Telemetry::read()
  uint8_t times;  ///< 1..8, 8 means 8 or more: how often in a row each slot has come with these data
};

/// Holds the newest data of all 32 slots, in 152 bytes. Once the second of two frames has come, the bytes between them
/// are accepted: all, if they are just slots (readSlots()), otherwise those slots that are certainly whole
/// (wholeSlots()).
///
/// The context that reads the port calls the events; they may interrupt read().
class Telemetry : public NoEvents {
 public:
  /// How often in a row a slot may be missing before its data are too old: a slot comes every 60 ms.
  static constexpr uint8_t MissesMax = 16;

  /// Copies the data of `count` slots from slot `first` on to `data`. Returns false, and leaves `data` unchanged,
  /// unless each of them came in one of its last 16 rounds (1 s). All of them are from one moment: from the first call
  /// on, these slots only change together.
  bool read(uint8_t first, uint8_t count, SlotData *data);

  /// Also reports how far the data can be trusted.
  bool read(uint8_t first, uint8_t count, SlotData *data, Trust &trust);

  /// Returns how often the bytes after a frame that announces a group were not just slots of this group.
  uint32_t rejectedGroups() const { return _rejected; }

  /// Forgets all data: they came before a time that nothing has measured.
  void forgetAll();

  // The events of a FrameFinder.
  void begin();                                     ///< see NoEvents
  void interval(uint32_t us) { _interval = us; }    ///< see NoEvents
  void accepted(const uint8_t *frame);              ///< see NoEvents
  void lost() { _count = Lost; }                    ///< see NoEvents
  void discarded(const uint8_t *bytes, int count);  ///< see NoEvents

 protected:
  /// Moves the data that slot `slot` brought between the two newest frames to `data`. Returns false if it brought none.
  bool takeEcho(uint8_t slot, SlotData &data);

  /// Like accepted(), without wholeSlots(): some 500 bytes less on a Cortex-M0+.
  void acceptWhole(const uint8_t *frame);

 private:
  static constexpr uint8_t Lost = UINT8_MAX;
  static constexpr uint8_t Time = 0x20, TimesMax = 0xE0;  // of _seen
  static constexpr uint8_t Old = MissesMax + 1;

  uint8_t misses(int slot) const { return _seen[slot] & (Time - 1); }
  void put(uint8_t slot, const SlotData &data);
  uint8_t countRound(uint8_t first);
  bool findAll(uint8_t &found, SlotData *data, uint8_t &expected);
  uint8_t findSome(uint8_t newest, SlotData *data, uint8_t expected) const;
  void keep(uint8_t found, const SlotData *data);
  void next(uint8_t newest);
  void countRounds(uint8_t frames);

  SlotData _data[SlotCount];
  uint8_t _seen[SlotCount];  // rounds since the slot came; above MissesMax: no data. And Time for each time it repeated
  uint8_t _characters[GroupSizeMax + 1];  // the first since the frame before
  uint8_t _count;                         // of all since; or Lost: many, or some are missing
  uint8_t _end;                           // end byte of the frame before them
  uint16_t _changes = 0;
  uint32_t _interval = 0;  // us, of the two newest frames
  uint32_t _rejected;
  uint32_t _breaks;                           // see readSlots()
  uint8_t _joined[SlotCount / SlotsOfGroup];  // bit k: the group's slots k and k + 1 are read together
};

}  // namespace sbus
