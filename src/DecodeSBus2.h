/// @file
/// Decodes the telemetry of an S.BUS2 line as well: what the receiver and sensors send between two frames.
#pragma once

#include "DecodeSBus.h"
#include "sbus/Sensors.h"
#include "sbus/Telemetry.h"

/// Decodes sixteen channels and two switches as DecodeSBus does, and the telemetry of an S.BUS2 line:
///
///     DecodeSBus2 dSBus(Serial1);
///     sbus::ReceiverVoltage voltage;
///     if (dSBus.readSensor(0, voltage)) { Serial.println(voltage.decivolts); }
///
/// A slot does not say which sensor fills it: read it as the type that the radio has for this slot. There is no
/// checksum: if a wrong value would do harm, believe a value when it has come twice.
class DecodeSBus2 : public DecodeSBusOf<sbus::Frame16, sbus::Telemetry> {
 public:
  /// See DecodeSBusOf().
  template <typename Port>
  explicit DecodeSBus2(Port &port) : DecodeSBusOf(port) {}

  /// See DecodeSBusOf(), with pins.
  template <typename Port>
  DecodeSBus2(Port &port, int8_t rx, int8_t tx) : DecodeSBusOf(port, rx, tx) {}

  /// Reads the sensor whose first slot is `slot`, 0..31; slot 0 is the receiver's own (sbus::ReceiverVoltage). Returns
  /// true if all of its slots have come within the last second; otherwise `sensor` is unchanged. It may be called at
  /// any rate, as decodeSBusFrame(). Values are known one frame, 15 ms, after they were sent.
  template <typename Sensor>
  bool readSensor(uint8_t slot, Sensor &sensor) {
    sbus::SlotData data[Sensor::Slots];
    if (!readSlots(slot, Sensor::Slots, data)) {
      return false;
    }
    sensor.decode(data);
    return true;
  }

  /// Copies the data of `count` slots from slot `first` on to `data`, for sensors that sbus/Sensors.h does not know.
  /// Returns like readSensor().
  bool readSlots(uint8_t first, uint8_t count, sbus::SlotData data[]) {
    return SBusFrameOk() && _finder.events().read(first, count, data);
  }

  /// Returns how many times the bytes between two frames were not just slots of the announced group, since begin(): a
  /// disturbance, two sensors in one slot, or a sensor that sends at the wrong time.
  uint32_t rejectedGroups() const { return _finder.events().rejectedGroups(); }
};
