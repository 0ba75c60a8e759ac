// A Calibrator, and a radio whose sticks are moved, as a sketch feeds them.
#pragma once

#include <array>
#include <cstring>
#include <initializer_list>

#include "BitByBit.h"
#include "sbus/Calibrator.h"

struct Extent {
  int low, high;
};

struct Radio {
  static constexpr uint16_t Rest = 992;
  static constexpr uint8_t NoChannel = 99;

  // Low, centre, high and dead zone.
  using Numbers = std::array<uint16_t, 4>;
  static constexpr Numbers NotTouched = {11, 22, 33, 44};

  sbus::Calibrator calibrator;
  Channels channels;  // all rest but those that are moved

  Radio() { channels.fill(Rest); }

  // CH1 goes through its travel, then rests.
  Radio(Extent travel, Extent rest, int deadZone = -1) : Radio() {
    if (deadZone >= 0) {
      calibrator.setDeadZone(static_cast<uint16_t>(deadZone));
    }
    move({travel.low, travel.high});
    calibrator.centre();
    move({rest.low, rest.high});
  }

  void feed() { calibrator.feed(channels.data(), false, false); }

  // CH1.
  void move(std::initializer_list<int> values) {
    for (const int value : values) {
      channels[0] = static_cast<uint16_t>(value);
      feed();
    }
  }

  sbus::Refusal refusal(uint8_t channel = 0) const {
    sbus::CalibratedChannel found;
    return calibrator.result(channel, found);
  }

  static Numbers numbersOf(const sbus::CalibratedChannel &channel) {
    return {channel.range.low, channel.range.centre, channel.range.high, channel.deadZone};
  }
  Numbers found(uint8_t channel = 0) const {
    sbus::CalibratedChannel found = {{NotTouched[0], NotTouched[1], NotTouched[2]}, NotTouched[3]};
    calibrator.result(channel, found);
    return numbersOf(found);
  }
};

// What finish() answers, and leaves of a calibration that was all A5.
struct Finished {
  sbus::Calibration calibration;
  uint8_t channel = Radio::NoChannel;
  sbus::Refusal refusal;

  Finished(const sbus::Calibrator &calibrator, unsigned wanted) {
    std::memset(&calibration, 0xA5, sizeof calibration);
    refusal = calibrator.finish(static_cast<uint16_t>(wanted), calibration, channel);
  }
  Radio::Numbers operator[](size_t index) const { return Radio::numbersOf(calibration.channels[index]); }
  bool isGood() const { return sbus::stateOf(calibration) == sbus::StoredState::Good; }
  bool isTouched() const {
    uint8_t filled[sizeof calibration];
    std::memset(filled, 0xA5, sizeof filled);
    return std::memcmp(&calibration, filled, sizeof filled) != 0;
  }
};
