/// @file
/// Decodes an S.BUS2 line: frames, and the telemetry that the receiver and sensors send between two frames.
#pragma once

#include "DecodeSBus.h"
#include "sbus2/Sensors.h"
#include "sbus2/Telemetry.h"

/// Decodes sixteen channels and two switches like DecodeSBus, and the telemetry of an S.BUS2 line:
///
///     DecodeSBusTelemetry dSBus(Serial1);
///     sbus::ReceiverVoltage voltage;
///     if (dSBus.readSensor(0, voltage)) { Serial.println(voltage.decivolts); }
///
/// Slots carry no sensor type: read a slot as the type that the radio has for it. There is no
/// checksum: if a wrong value would do harm, trust a value only once it has come twice (`trust.times` of readSensor()).
template <typename Events, typename Polling = sbus::PolledByLoop>
class DecodeSBusTelemetryOf : public DecodeSBusOf<sbus::Frame16, Events, Polling> {
  using Decoder = DecodeSBusOf<sbus::Frame16, Events, Polling>;

 public:
  template <typename Other>
  using PolledBy = DecodeSBusTelemetryOf<Events, Other>;  ///< see DecodeSBusOf
  using Decoder::Decoder;                                 ///< see DecodeSBusOf()

  /// Reads the sensor in the slots from `slot` on, 0..31, into `sensor`: a type of sbus2/Sensors.h, or one of your own
  /// with `Slots` and `decode()`. Slot 0 is the receiver's own, sbus::ReceiverVoltage. Returns true if all of the
  /// sensor's slots have come within the last second; otherwise `sensor` is unchanged. All values of a sensor are from
  /// one moment, and can be read one frame, 15 ms, after they were sent. From the first call for a sensor on, its slots
  /// are kept together. If the slots before that call came apart, it returns false until they come together. Call it at
  /// any rate, from where decodeSBusFrame() may be called.
  template <typename Sensor>
  bool readSensor(uint8_t slot, Sensor &sensor) {
    const typename Decoder::Lock lock(*this);
    sbus::SlotData data[Sensor::Slots];
    if (!this->isOk() || !this->_finder.events().read(slot, Sensor::Slots, data)) {
      return false;
    }
    sensor.decode(data);
    return true;
  }

  /// Reads the sensor, and says how far its values can be trusted. `trust.age`: their age in ms, at most 10 ms too high
  /// (60 ms with FASSTest 12CH, and after four lost frames in a row); 65535 means 65535 or more. `trust.times`: how
  /// often in a row they have come unchanged, 1..8; 8 means 8 or more. `trust` changes only if it returns true.
  template <typename Sensor>
  bool readSensor(uint8_t slot, Sensor &sensor, sbus::Trust &trust) {
    const typename Decoder::Lock lock(*this);
    sbus::SlotData data[Sensor::Slots];
    sbus::Trust now;
    uint32_t frames;
    unsigned long age;
    do {  // a frame may come in between: then the age would be that of neither
      frames = this->_finder.counters().frames;
      sbus::barrier();
      if (!this->isOk() || !this->_finder.events().read(slot, Sensor::Slots, data, now)) {
        return false;
      }
      age = now.age + this->ageInMs();
      sbus::barrier();
    } while (frames != this->_finder.counters().frames);
    now.age = static_cast<uint16_t>(age < UINT16_MAX ? age : UINT16_MAX);
    trust = now;
    sensor.decode(data);
    return true;
  }

  /// Returns how many times since begin() the bytes between two frames were not just slots of the announced group.
  /// Slots of a rejected group that are certainly whole are still read, except by an SBus2Sensor. The cause is a
  /// disturbance, two sensors in one slot, or a sensor that sends at the wrong time.
  uint32_t rejectedGroups() const {
    const typename Decoder::Lock lock(*this);
    return this->_finder.events().rejectedGroups();
  }
};

/// Decodes an S.BUS2 line, and only listens. SBus2Sensor also answers.
using DecodeSBusTelemetry = DecodeSBusTelemetryOf<sbus::Telemetry>;
