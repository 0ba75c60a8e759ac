/// @file
/// Keeps the newest telemetry of an S.BUS2 line, from the events of a FrameFinder.
///
/// Not part of the interface: it may change in any release.
#pragma once

#include <stdint.h>

#include "FrameFinder.h"
#include "Slots.h"

namespace sbus {

/// Holds the newest data of all 32 slots. The bytes between two frames are accepted once the second frame is there, and
/// only if all of them are slots (readSlots()). It needs 144 bytes.
///
/// The context that reads the port calls the events; they may interrupt read().
class Telemetry {
 public:
  /// How often in a row a slot may be missing before its data are too old: a slot comes every 60 ms.
  static constexpr uint8_t MissesMax = 16;

  /// Copies the data of `count` slots from slot `first` on to `data`. Returns false, and leaves `data` unchanged,
  /// unless each of them came in one of its last 16 rounds (1 s). All of them are of one moment.
  bool read(uint8_t first, uint8_t count, SlotData *data) const;

  /// Returns how many times the bytes after a frame that announces a group were not just slots of this group.
  uint32_t rejectedGroups() const { return _rejected; }

  // The events of a FrameFinder.
  void begin();                                         ///< see NoEvents
  void taken(const uint8_t *frame);                     ///< see NoEvents
  void extra() { lost(); }                              ///< see NoEvents
  void lost() { _count = GroupSizeMax + 1; }            ///< see NoEvents
  void discarded(const uint8_t *bytes, int count);      ///< see NoEvents
  void rejected(int, Rejection) {}                      ///< see NoEvents
  static constexpr bool seesEachGap() { return true; }  ///< see NoEvents
  static constexpr bool wantsTimes() { return false; }  ///< see NoEvents
  void asked(int, uint32_t) {}                          ///< see NoEvents

 protected:
  /// Forgets what slot `slot` has brought between the two newest frames, and copies it to `data`. Returns false if it has
  /// brought nothing.
  bool forget(uint8_t slot, SlotData &data);

 private:
  SlotData _data[SlotCount];
  uint8_t _misses[SlotCount];  // rounds since the slot came; above MissesMax: no data
  uint8_t _characters[GroupSizeMax];
  uint8_t _count;  // of _characters; above GroupSizeMax: something other than a group
  uint8_t _end;    // end byte of the frame before them
  uint16_t _changes = 0;
  uint32_t _rejected;
  uint32_t _breaks;  // see readSlots()
};

}  // namespace sbus
