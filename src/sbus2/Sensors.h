/// @file
/// What the slots of Futaba's sensors mean, both ways, with integers only. Slots.h finds slots on a line.
///
/// Each type has its number of `Slots`, which follow one another within a group. `decode()` reads them, and `encode()`
/// writes them: `decode()` gives back the values that `encode()` has written, within the ranges given. For a value out
/// of range `encode()` writes the nearest value in range, and returns false. A slot does not say which sensor fills it;
/// decode it as the type that the radio has for this slot.
///
/// Sources, two or more for each: github.com/BrushlessPower/SBUS2-Telemetry (src/SBUS2.cpp), github.com/dgatf/msrc
/// (board/project/protocol/sbus.c), github.com/mstrens/oXs_on_RP2040 (src/sbus2_tlm.cpp and its documents),
/// github.com/delamonpansie/jitel. Where they disagree, a type says so.
///
/// All functions may be called from any context.
#pragma once

#include <stdint.h>

#include "Slots.h"

namespace sbus {

/// The receiver's own voltage, in slot 0: its supply and an external voltage in turn, each every 120 ms. Never send it.
struct ReceiverVoltage {
  static constexpr uint8_t Slots = 1;  ///< how many slots
  uint16_t decivolts;                  ///< 0.1 V, 0..1023
  bool isExternal;                     ///< the external input's; otherwise the receiver's supply
  void decode(const SlotData *slots);  ///< reads them
  bool encode(SlotData *slots) const;  ///< writes them; returns false if one was out of range
};

/// Temperature: SBS-01T, P-SBS/01T.
struct TemperatureSbs01T {
  static constexpr uint8_t Slots = 1;  ///< how many slots
  int16_t degrees;                     ///< degrees Celsius, -100..32667
  void decode(const SlotData *slots);  ///< reads them
  bool encode(SlotData *slots) const;  ///< writes them; returns false if one was out of range
};

/// Temperature: TEMP-F1713, "Temp125".
struct TemperatureF1713 {
  static constexpr uint8_t Slots = 1;  ///< how many slots
  int16_t degrees;                     ///< degrees Celsius, -16384..16383
  void decode(const SlotData *slots);  ///< reads them
  bool encode(SlotData *slots) const;  ///< writes them; returns false if one was out of range
};

/// Speed of rotation: SBS-01RM, SBS-01RO, SBS-01RB; the radio is set to "magnet" and a ratio of 1.00.
struct RotationSbs01R {
  static constexpr uint8_t Slots = 1;  ///< how many slots
  uint32_t rpm;                        ///< 1/min, 0..393215, rounded down to a multiple of 6
  void decode(const SlotData *slots);  ///< reads them
  bool encode(SlotData *slots) const;  ///< writes them; returns false if one was out of range
};

/// Voltages: SBS-01V.
struct VoltageSbs01V {
  static constexpr uint8_t Slots = 2;  ///< how many slots
  uint16_t batteryDecivolts;           ///< 0.1 V, 0..8191
  uint16_t externalDecivolts;          ///< 0.1 V, 0..8191
  void decode(const SlotData *slots);  ///< reads them
  bool encode(SlotData *slots) const;  ///< writes them; returns false if one was out of range
};

/// Current, voltage and charge: CURR-F1678 and SBS-01C. A real SBS-01C counts in steps of 0.08 V and 0.64 A.
struct CurrentF1678 {
  static constexpr uint8_t Slots = 3;  ///< how many slots
  int16_t centiamperes;                ///< 0.01 A, -16384..16383
  uint16_t centivolts;                 ///< 0.01 V
  uint16_t milliampereHours;           ///< mAh
  void decode(const SlotData *slots);  ///< reads them
  bool encode(SlotData *slots) const;  ///< writes them; returns false if one was out of range
};

/// Climb and altitude: VARIO-F1672. A radio takes the first altitude as zero.
struct VarioF1672 {
  static constexpr uint8_t Slots = 2;  ///< how many slots
  int16_t centimetresPerSecond;        ///< 0.01 m/s
  int16_t metres;                      ///< m, -16384..16383
  void decode(const SlotData *slots);  ///< reads them
  bool encode(SlotData *slots) const;  ///< writes them; returns false if one was out of range
};

/// Climb and altitude: VARIO-F1712.
struct VarioF1712 {
  static constexpr uint8_t Slots = 2;  ///< how many slots
  int16_t decimetresPerSecond;         ///< 0.1 m/s
  int16_t metres;                      ///< m, -16384..16383
  void decode(const SlotData *slots);  ///< reads them
  bool encode(SlotData *slots) const;  ///< writes them; returns false if one was out of range
};

/// Air speed: SBS-01TAS.
struct AirSpeedSbs01Tas {
  static constexpr uint8_t Slots = 1;  ///< how many slots
  uint16_t kilometresPerHour;          ///< km/h, 0..16383
  void decode(const SlotData *slots);  ///< reads them
  bool encode(SlotData *slots) const;  ///< writes them; returns false if one was out of range
};

/// Position and speed: GPS-F1675, from slot 8, 16 or 24. A position beyond its range or with 60 minutes or more is read
/// as no fix: some senders destroy bits of the minutes in the south and in the west (BrushlessPower/SBUS2-Telemetry).
struct GpsF1675 {
  static constexpr uint8_t Slots = 8;  ///< how many slots
  uint16_t kilometresPerHour;          ///< km/h, 0..16383
  bool hasFix;                         ///< position and speed are valid
  int16_t metres;                      ///< altitude, m, -16384..16383
  uint16_t secondsOfDay;               ///< UTC, s; ends at 18:12:15, and some send a time of twelve hours
  int16_t decimetresPerSecond;         ///< climb, 0.1 m/s
  int32_t latitude;                    ///< 1/600000 degree, north is positive, within +-54000000
  int32_t longitude;                   ///< 1/600000 degree, east is positive, within +-108000000
  void decode(const SlotData *slots);  ///< reads them
  bool encode(SlotData *slots) const;  ///< writes them; returns false if one was out of range
};

/// Position, speed and air pressure: SBS-01G and SBS-02G, from slot 8, 16 or 24. A position beyond its range is read as
/// no fix. The offset of `decimetres` is disputed: sources have 820 m, 1500 m and 1638.3 m; 820 m, which is here, fits
/// a real sensor's pressure best.
struct GpsSbs01G {
  static constexpr uint8_t Slots = 8;  ///< how many slots
  uint32_t secondsOfDay;               ///< UTC, s, 0..131071
  int32_t latitude;                    ///< 1/600000 degree, north is positive, within +-54000000
  int32_t longitude;                   ///< 1/600000 degree, east is positive, within +-108000000
  uint16_t kilometresPerHour;          ///< km/h, 0..511
  bool hasFix;                         ///< position and speed are valid
  uint8_t satellites;                  ///< coarse, 0..3
  uint16_t decapascals;                ///< air pressure, 10 Pa (0.1 hPa), 0..16383
  int32_t decimetres;                  ///< altitude, 0.1 m, -8200..57335
  int16_t decimetresPerSecond;         ///< climb, 0.1 m/s, -1500..2595
  bool hasPressure;                    ///< pressure, altitude and climb are valid
  void decode(const SlotData *slots);  ///< reads them
  bool encode(SlotData *slots) const;  ///< writes them; returns false if one was out of range
};

}  // namespace sbus
