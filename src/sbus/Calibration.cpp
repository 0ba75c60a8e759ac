#include "Calibration.h"

namespace sbus {

namespace {

constexpr uint16_t CheckStart = 0xFFFF;
constexpr uint16_t CheckPolynomial = 0x1021;

// Bit by bit: it is called once, when the sketch starts, and a table would take 512 bytes.
uint16_t checkValueOf(const Calibration &calibration) {
  const uint8_t *const bytes = reinterpret_cast<const uint8_t *>(&calibration);
  unsigned check = CheckStart;
  for (size_t i = 0; i < offsetof(Calibration, checkValue); i++) {
    check ^= static_cast<unsigned>(bytes[i]) << 8;
    for (uint8_t bit = 0; bit < 8; bit++) {
      const bool carry = (check & 0x8000) != 0;
      check = (check << 1 ^ (carry ? CheckPolynomial : 0u)) & 0xFFFF;
    }
  }
  return static_cast<uint16_t>(check);
}

uint16_t distance(uint16_t a, uint16_t b) { return static_cast<uint16_t>(a < b ? b - a : a - b); }

// Returns `value` moved towards the centre by the dead zone; the centre if it lies within the dead zone.
uint16_t drawnIn(uint16_t value, const CalibratedChannel &channel) {
  const uint16_t centre = channel.range.centre;
  if (distance(value, centre) <= channel.deadZone) {
    return centre;
  }
  return static_cast<uint16_t>(value < centre ? value + channel.deadZone : value - channel.deadZone);
}

Range drawnIn(const CalibratedChannel &channel) {
  return {drawnIn(channel.range.low, channel), channel.range.centre, drawnIn(channel.range.high, channel)};
}

}  // namespace

bool isPossible(const CalibratedChannel &channel) {
  const Range &range = channel.range;
  if (!isCalibrated(channel)) {
    return range.low == 0 && range.centre == 0 && channel.deadZone == 0;
  }
  return range.low <= ChannelMax && range.high <= ChannelMax &&
         (range.low < range.centre) == (range.centre < range.high) &&
         distance(range.low, range.centre) > channel.deadZone && distance(range.high, range.centre) > channel.deadZone;
}

void seal(Calibration &calibration) {
  calibration.version = CalibrationVersion;
  calibration.checkValue = checkValueOf(calibration);
}

StoredState stateOf(const Calibration &calibration) {
  if (calibration.version != CalibrationVersion) {
    return StoredState::OtherVersion;
  }
  if (calibration.checkValue != checkValueOf(calibration)) {
    return StoredState::Damaged;
  }
  for (const CalibratedChannel &channel : calibration.channels) {
    if (!isPossible(channel)) {
      return StoredState::Impossible;
    }
  }
  return StoredState::Good;
}

int16_t CalibratedChannel::toNormalized(uint16_t raw) const {
  return sbus::toNormalized(drawnIn(raw, *this), drawnIn(*this));
}

int16_t CalibratedChannel::toMicroseconds(uint16_t raw) const {
  return sbus::toMicroseconds(drawnIn(raw, *this), drawnIn(*this));
}

}  // namespace sbus
