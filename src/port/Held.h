/// @file
/// Keeps an interrupt or a task from reading the port while loop() is in one of a decoder's methods.
///
/// Not part of the interface: it may change in any release.
#pragma once

#include <stdint.h>

#include "../sbus/Counters.h"
#include "../sbus/Link.h"

namespace sbus {

struct Trust;

/// The methods of `Decoder` for a sketch in which an interrupt or a task polls the port: it waits while one of them
/// runs. Call them only from setup() and loop(). `Holder::Hold` makes it wait.
template <typename Decoder, typename Holder>
class HeldOf : public Decoder, protected Holder {
  using Hold = typename Holder::Hold;

 public:
  /// Constructs a `Decoder`.
  using Decoder::Decoder;

  /// See DecodeSBusOf.
  bool read(typename Decoder::Frame &frame) {
    const Hold hold(*this);
    return Decoder::read(frame);
  }
  /// See DecodeSBusOf.
  bool SBusFrameOk() {
    const Hold hold(*this);
    return Decoder::SBusFrameOk();
  }
  /// See DecodeSBusOf.
  void decodeSBusFrame(typename Decoder::ChannelArray channels, bool &failsafe, bool &lostFrame) {
    const Hold hold(*this);
    Decoder::decodeSBusFrame(channels, failsafe, lostFrame);
  }
  /// See DecodeSBus.
  bool decodeExtraChannels(ChannelArray<uint16_t, ProportionalCount> channels) {
    const Hold hold(*this);
    return Decoder::decodeExtraChannels(channels);
  }
  /// See DecodeSBusOf.
  bool newFrame() {
    const Hold hold(*this);
    return Decoder::newFrame();
  }
  /// See DecodeSBusOf.
  LinkState linkState() {
    const Hold hold(*this);
    return Decoder::linkState();
  }
  /// See DecodeSBusOf.
  unsigned long frameAge() {
    const Hold hold(*this);
    return Decoder::frameAge();
  }
  /// See DecodeSBusOf.
  Counters counters() const {
    const Hold hold(*this);
    return Decoder::counters();
  }
  /// See DecodeSBusOf. It may also be called while frames come in.
  void setLossLimit(uint16_t frames) {
    const Hold hold(*this);  // an AVR writes its two bytes one by one
    Decoder::setLossLimit(frames);
  }
  /// See DecodeSBusTelemetryOf.
  template <typename Sensor>
  bool readSensor(uint8_t slot, Sensor &sensor) {
    const Hold hold(*this);
    return Decoder::readSensor(slot, sensor);
  }
  /// See DecodeSBusTelemetryOf.
  template <typename Sensor>
  bool readSensor(uint8_t slot, Sensor &sensor, Trust &trust) {
    const Hold hold(*this);
    return Decoder::readSensor(slot, sensor, trust);
  }
  /// See DecodeSBusTelemetryOf.
  uint32_t rejectedGroups() const {
    const Hold hold(*this);
    return Decoder::rejectedGroups();
  }
};

}  // namespace sbus
