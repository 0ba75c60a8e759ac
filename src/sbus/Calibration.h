/// @file
/// What one radio really sends: the travel of its channels, for a sketch to keep in EEPROM and to scale by.
/// Calibrator.h finds it out.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "Frame.h"
#include "Scaling.h"

namespace sbus {

/// One channel. All 0: not calibrated, and scaled it is always at its centre.
struct CalibratedChannel {
  Range range;        ///< its low above its high: the channel runs backwards
  uint16_t deadZone;  ///< raw counts, 0..2047: so far from the centre, on either side, it is still at the centre

  /// Thousandths: exactly -1000, 0 and +1000 at low, centre and high; 0 within the dead zone, no step after it. Beyond
  /// low and high it goes on: see limited().
  int16_t toNormalised(uint16_t raw) const;

  /// The same in us: 988, 1500 and 2012. A channel that is not calibrated gives 1500, half throttle if it is the
  /// throttle: ask isCalibrated(), or let the calibration want it.
  int16_t toMicroseconds(uint16_t raw) const;
};

/// All channels, 132 bytes without a pointer: store it as it is, by EEPROM.put() or the like. It is read by boards of
/// the same byte order.
struct Calibration {
  uint16_t version;                               ///< CalibrationVersion
  CalibratedChannel channels[ProportionalCount];  ///< CH1..CH16
  uint16_t checkValue;                            ///< CRC-16/CCITT-FALSE of all that stands before it
};

/// Of this layout. Erased EEPROM holds 0 or FFFF, which are no version.
constexpr uint16_t CalibrationVersion = 1;

static_assert(sizeof(Calibration) == 4 + 8 * ProportionalCount, "it is stored: no byte may stand between its members");

/// What became of a calibration that was stored.
enum class StoredState : uint8_t {
  Good,          ///< as it was when it was sealed: the only one to be used
  OtherVersion,  ///< nothing has been stored there yet, or something else
  Damaged,       ///< bytes have changed since it was sealed
  Impossible,    ///< it was sealed with a channel that cannot be: see isPossible()
};

/// True if a channel has been calibrated: its range has a length.
constexpr bool isCalibrated(const CalibratedChannel &channel) {
  return channel.range.low != channel.range.high;
}

/// True if a channel is not calibrated (all 0), or can be scaled by: its centre lies between its ends, none of the
/// three is above 2047, and the dead zone ends before them.
bool isPossible(const CalibratedChannel &channel);

/// Sets version and check value. Call it after every change, before you store it.
void seal(Calibration &calibration);

/// May what was read back be used? Only if Good. Any bytes are well defined.
StoredState stateOf(const Calibration &calibration);

}  // namespace sbus
