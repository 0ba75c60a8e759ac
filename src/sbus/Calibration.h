/// @file
/// The travel of the channels of one radio, for a sketch to store in EEPROM and to scale by. Calibrator.h measures it.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "Frame.h"
#include "Scaling.h"

namespace sbus {

/// The calibration of one channel. If all members are 0, the channel is not calibrated, and always scales to its
/// centre.
struct CalibratedChannel {
  Range range;        ///< low above high: the channel is reversed
  uint16_t deadZone;  ///< raw counts, 0..2047, on either side of the centre, that scale to the centre

  /// Returns thousandths of the travel: exactly -1000, 0 and +1000 at low, centre and high; 0 within the dead zone,
  /// without a step at its edge. Values beyond low and high are not clamped: see limited().
  int16_t toNormalized(uint16_t raw) const;

  /// Returns a servo's pulse in us: 988, 1500 and 2012 at low, centre and high. A channel that is not calibrated gives
  /// 1500, half throttle on the throttle: ask isCalibrated(), or require the channel in Calibrator::finish().
  int16_t toMicroseconds(uint16_t raw) const;
};

/// The calibration of all channels, 132 bytes without a pointer: EEPROM.put() can store it. Boards of the same byte
/// order can read it.
struct Calibration {
  uint16_t version;                               ///< CalibrationVersion
  CalibratedChannel channels[ProportionalCount];  ///< CH1..CH16
  uint16_t checkValue;                            ///< CRC-16/CCITT-FALSE of all the bytes before it
};

/// The version of this layout. Erased EEPROM holds 0 or FFFF, which are never versions.
constexpr uint16_t CalibrationVersion = 1;

static_assert(sizeof(Calibration) == 4 + 8 * ProportionalCount, "it is stored as raw bytes: no padding is allowed");

/// The state of a stored calibration.
enum class StoredState : uint8_t {
  Good,          ///< unchanged since it was sealed: the only one to use
  OtherVersion,  ///< nothing or something else was stored there
  Damaged,       ///< bytes have changed since it was sealed
  Impossible,    ///< it was sealed with a channel for which isPossible() is false
};

/// Returns true if the channel is calibrated: its low and high differ.
constexpr bool isCalibrated(const CalibratedChannel &channel) { return channel.range.low != channel.range.high; }

/// Returns true if the channel is not calibrated (all 0), or if its centre lies between its ends, all three are at most
/// 2047, and the dead zone ends before the ends.
bool isPossible(const CalibratedChannel &channel);

/// Sets version and check value. Call it after every change, before you store it.
void seal(Calibration &calibration);

/// Returns the state of a calibration that was read back: use it only if Good. Any bytes are allowed.
StoredState stateOf(const Calibration &calibration);

}  // namespace sbus
