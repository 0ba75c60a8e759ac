/// @file
/// Keeps an interrupt or a task from reading the port while loop() is in one of a decoder's methods.
///
/// Not part of the interface: it may change in any release.
#pragma once

#include <stdint.h>

#include "../sbus/Counters.h"
#include "../sbus/Link.h"

namespace sbus {

class LinkQuality;
struct Trust;

/// The methods of `Decoder` for a sketch in which an interrupt or a task polls the port: it waits while one of them
/// runs. Call them only from setup() and loop(). `Holder::Hold` makes it wait.
///
/// A function that takes a `Decoder &` would call methods that do not lock, and a begin() that starts no timer: with a
/// protected base such a call does not compile. The derived class adds the methods that open, close and read the port.
template <typename Decoder, typename Holder>
class HeldOf : protected Decoder, protected Holder {
  using Hold = typename Holder::Hold;

 public:
  using ChannelArray = typename Decoder::ChannelArray;  ///< see DecodeSBusOf
  using Frame = typename Decoder::Frame;                ///< see DecodeSBusOf

  /// Constructs a `Decoder`.
  using Decoder::Decoder;

  using Decoder::setTimeout;  ///< see DecodeSBusOf

  /// See DecodeSBusOf.
  bool SBusFrameOk() {
    const Hold hold(*this);
    return Decoder::SBusFrameOk();
  }
  /// See DecodeSBusOf.
  void decodeSBusFrame(ChannelArray channels, bool &failsafe, bool &lostFrame) {
    const Hold hold(*this);
    Decoder::decodeSBusFrame(channels, failsafe, lostFrame);
  }
  /// See DecodeSBus32.
  bool decodeExtraChannels(sbus::ChannelArray<uint16_t, ProportionalCount> channels) {
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

 private:
  friend class LinkQuality;  // for the clock
};

}  // namespace sbus
