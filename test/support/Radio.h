// A Calibrator, and a radio with moving sticks, which are fed to it as a sketch would.
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
  Channels channels;  // all rest, except those that are moved
  bool backwards = false;

  Radio() { channels.fill(Rest); }

  // Moves CH1 through its travel, lets it rest, and holds it at its high end, or at its low end if it rests less than
  // 1/4 below the high end.
  Radio(Extent travel, Extent rest, int deadZone = -1) : Radio() {
    if (deadZone >= 0) {
      calibrator.setDeadZone(static_cast<uint16_t>(deadZone));
    }
    move({travel.low, travel.high});
    calibrator.centre();
    move({rest.low, rest.high});
    const int low = travel.low < travel.high ? travel.low : travel.high;
    const int high = travel.low < travel.high ? travel.high : travel.low;
    backwards = high - rest.low <= (high - low) / 4;
    calibrator.high();
    hold(backwards ? low : high);
  }

  void feed() { calibrator.feed(channels.data(), false, false); }

  void feed(int frames) {
    while (frames-- > 0) {
      feed();
    }
  }

  // CH1.
  void stay(int value, int frames) {
    channels[0] = static_cast<uint16_t>(value);
    feed(frames);
  }
  void move(std::initializer_list<int> values) {
    for (const int value : values) {
      stay(value, sbus::Calibrator::SeenFrames);
    }
  }
  void hold(int value) { stay(value, 100); }  // long enough to forget any place before

  sbus::CalibrationError error(uint8_t channel = 0) const {
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

// The result of finish(), and the calibration afterwards; it was all A5 before.
struct Finished {
  sbus::Calibration calibration;
  uint8_t channel = Radio::NoChannel;
  sbus::CalibrationError error;

  Finished(const sbus::Calibrator &calibrator, unsigned wanted) {
    std::memset(&calibration, 0xA5, sizeof calibration);
    error = calibrator.finish(static_cast<uint16_t>(wanted), calibration, channel);
  }
  Radio::Numbers operator[](size_t index) const { return Radio::numbersOf(calibration.channels[index]); }
  bool isGood() const { return sbus::stateOf(calibration) == sbus::StoredState::Good; }
  bool isTouched() const {
    uint8_t filled[sizeof calibration];
    std::memset(filled, 0xA5, sizeof filled);
    return std::memcmp(&calibration, filled, sizeof filled) != 0;
  }
};
