// The stored calibration is whole or rejected; scaling by it, or by a range, is exact over all 2048 values, and back.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "sbus/Calibration.h"
#include "support/ShowArrays.h"

namespace {

// ---- A second implementation of the rules of the stored calibration, one by one

// Returns true if a channel is not calibrated, or its numbers are in order and the dead zone ends before low and high.
bool possibleByRule(const sbus::CalibratedChannel &channel) {
  const int low = channel.range.low;
  const int centre = channel.range.centre;
  const int high = channel.range.high;
  const int dead = channel.deadZone;
  const bool empty = low == 0 && centre == 0 && high == 0 && dead == 0;
  const bool forwards = low < centre - dead && centre + dead < high && high <= 2047;
  const bool backwards = high < centre - dead && centre + dead < low && low <= 2047;
  return empty || forwards || backwards;
}

// Returns the CRC-16/CCITT-FALSE, bit by bit, through a register of 16 bits.
uint16_t crcOf(const uint8_t *bytes, size_t count) {
  unsigned crc = 0xFFFF;
  for (size_t bit = 0; bit < 8 * count; bit++) {
    const unsigned next = bytes[bit / 8] >> (7 - bit % 8) & 1u;
    crc = (crc << 1 & 0xFFFF) ^ ((crc >> 15 ^ next) * 0x1021);
  }
  return static_cast<uint16_t>(crc);
}

// Returns true if scaling gives exactly -1000, 0, +1000 and 988, 1500, 2012 us at the three points.
bool isExact(const sbus::CalibratedChannel &channel) {
  const sbus::Range &range = channel.range;
  return channel.toNormalized(range.low) == -1000 && channel.toMicroseconds(range.low) == 988 &&
         channel.toNormalized(range.centre) == 0 && channel.toMicroseconds(range.centre) == 1500 &&
         channel.toNormalized(range.high) == 1000 && channel.toMicroseconds(range.high) == 2012;
}

// Two straight lines from either end of the dead zone, in floating point, clamped as the library does: `centre` at the
// range's centre, `step` less at its low, and `step` more at its high.
double onTheLines(int raw, const sbus::CalibratedChannel &channel, double centre, double step) {
  const sbus::Range &range = channel.range;
  const int beyond = std::abs(raw - range.centre) - channel.deadZone;
  if (beyond <= 0) {
    return centre;
  }
  const bool towardsHigh = (raw > range.centre) == (range.high > range.centre);
  const int length = std::abs((towardsHigh ? range.high : range.low) - range.centre) - channel.deadZone;
  return std::clamp(centre + (towardsHigh ? step : -step) * beyond / length, -32767.0, 32767.0);
}

// ---- Channels and ranges

using sbus::CalibratedChannel;
using sbus::Calibration;
using sbus::StoredState;

constexpr int Values = 2048;
constexpr unsigned Size = 132;
using Stored = std::array<uint8_t, Size>;

constexpr CalibratedChannel Samples[] = {
    {sbus::FrSky, 0},         // what an untrimmed radio sends
    {sbus::FrSky, 8},         // with the dead zone of a Calibrator
    {sbus::Futaba, 8},        //
    {{78, 1024, 1964}, 20},   // a Futaba's +-140 %
    {{1811, 992, 172}, 8},    // backwards
    {{1800, 700, 100}, 99},   // ... and off its middle
    {{0, 1024, 2047}, 0},     // the whole range
    {{0, 1024, 2047}, 1022},  // ... nearly all in the dead zone
    {{300, 400, 1900}, 99},   // one side short, and nearly all in the dead zone
    {{1000, 1001, 1002}, 0},  // as short as can be
    {{2047, 2046, 2045}, 0},  // ... backwards
    {{172, 992, 1811}, 818},  // one count is left above the dead zone, two below
};

CalibratedChannel reversed(CalibratedChannel channel) {
  std::swap(channel.range.low, channel.range.high);
  return channel;
}

// The other channels are not calibrated.
Calibration sealedWith(const CalibratedChannel &channel, size_t index) {
  Calibration calibration = {};
  calibration.channels[index] = channel;
  seal(calibration);
  return calibration;
}

// All kinds of channels, and four that are not calibrated.
Calibration known() {
  Calibration calibration = {};
  std::copy(std::begin(Samples), std::end(Samples), calibration.channels);
  seal(calibration);
  return calibration;
}

Stored bytesOf(const Calibration &calibration) {
  Stored bytes;
  std::memcpy(bytes.data(), &calibration, Size);
  return bytes;
}

StoredState stateOf(const Stored &bytes) {
  Calibration calibration;
  std::memcpy(&calibration, bytes.data(), Size);
  return sbus::stateOf(calibration);
}

constexpr struct {
  const char *name;
  sbus::Range range;
  bool isExact;  // no side is longer than 1000: thousandths tell all raw values apart
} Ranges[] = {
    {"FrSky", sbus::FrSky, true},
    {"Futaba", sbus::Futaba, true},
    {"Futaba, +-140 %", {78, 1024, 1964}, true},
    {"the whole range", {0, 1024, 2047}, false},
    {"backwards", {1811, 992, 172}, true},
    {"one side short", {900, 1000, 2000}, true},
    {"as short as can be", {1000, 1001, 1002}, true},
};

}  // namespace

TEST_CASE("the 132 bytes are the version, 16 times low, centre, high, dead zone, and the check value, low byte first") {
  Calibration calibration;
  Stored expected = {0x01, 0x00};
  for (size_t i = 0; i < 16; i++) {
    calibration.channels[i] = {{static_cast<uint16_t>(0x0100 + i), 0x0300, static_cast<uint16_t>(0x0500 + i)}, 8};
    const auto index = static_cast<uint8_t>(i);
    const uint8_t bytes[] = {index, 0x01, 0x00, 0x03, index, 0x05, 0x08, 0x00};
    std::copy_n(bytes, 8, expected.begin() + 2 + 8 * index);
  }
  // By Python's binascii.crc_hqx(bytes, 0xFFFF).
  expected[130] = 0xDA;
  expected[131] = 0x9C;
  seal(calibration);
  CHECK(sizeof calibration == Size);
  CHECK(bytesOf(calibration) == expected);
  CHECK(stateOf(expected) == StoredState::Good);
  CHECK(crcOf(expected.data(), 130) == 0x9CDA);  // the test's own implementation
}

TEST_CASE("one of 65536 versions is accepted, even if the check value is right; erased storage holds none") {
  for (unsigned version = 0; version < 0x10000; version++) {
    Calibration calibration = known();
    calibration.version = static_cast<uint16_t>(version);
    if (version % 256 == 0) {
      calibration.checkValue = crcOf(bytesOf(calibration).data(), 130);
    }
    if ((sbus::stateOf(calibration) == StoredState::OtherVersion) != (version != 1)) {
      FAIL("version ", version);
    }
  }
  for (const uint8_t erased : {uint8_t{0x00}, uint8_t{0xFF}}) {
    Stored bytes;
    bytes.fill(erased);
    CHECK(stateOf(bytes) == StoredState::OtherVersion);
  }
}

TEST_CASE("a stored calibration with any bit changed is not good") {
  for (size_t bit = 0; bit < 8 * Size; bit++) {
    CAPTURE(bit);
    Stored bytes = bytesOf(known());
    bytes[bit / 8] = static_cast<uint8_t>(bytes[bit / 8] ^ 1 << bit % 8);
    CHECK(stateOf(bytes) == (bit < 16 ? StoredState::OtherVersion : StoredState::Damaged));
  }
}

TEST_CASE("isPossible() applies each rule, on either side of each limit, for any channel") {
  const struct {
    const char *rule;
    CalibratedChannel channel;
    bool possible;
  } rows[] = {
      {"not calibrated", {{0, 0, 0}, 0}, true},
      {"not calibrated, but a dead zone", {{0, 0, 0}, 1}, false},
      {"not calibrated, but a centre", {{0, 1, 0}, 0}, false},
      {"no length, anywhere", {{992, 992, 992}, 0}, false},
      {"no length, the centre elsewhere", {{172, 992, 172}, 0}, false},
      {"low == centre", {{172, 172, 1811}, 0}, false},
      {"low just below centre", {{172, 173, 1811}, 0}, true},
      {"centre == high", {{172, 1811, 1811}, 0}, false},
      {"centre just below high", {{172, 1810, 1811}, 0}, true},
      {"centre below both", {{172, 171, 1811}, 0}, false},
      {"centre above both", {{172, 1812, 1811}, 0}, false},
      {"high at its highest", {{0, 1, 2047}, 0}, true},
      {"high above", {{0, 1, 2048}, 0}, false},
      {"high far above", {{0, 1, 65535}, 0}, false},
      {"all three above", {{3000, 4000, 5000}, 0}, false},
      {"dead zone ends before low", {{992 - 9, 992, 1811}, 8}, true},
      {"dead zone ends at low", {{992 - 8, 992, 1811}, 8}, false},
      {"dead zone ends before high", {{172, 992, 992 + 9}, 8}, true},
      {"dead zone ends at high", {{172, 992, 992 + 8}, 8}, false},
      {"dead zone as large as can be", {{0, 1024, 2047}, 1022}, true},
      {"... and one more", {{0, 1024, 2047}, 1023}, false},
      {"dead zone beyond all", {{0, 1024, 2047}, 65535}, false},
  };
  for (const auto &row : rows) {
    for (const CalibratedChannel &channel : {row.channel, reversed(row.channel)}) {
      INFO(row.rule, ", channel.range.low ", channel.range.low);
      CHECK(sbus::isCalibrated(channel) == (channel.range.low != channel.range.high));
      CHECK(sbus::isPossible(channel) == row.possible);
      CHECK(possibleByRule(channel) == row.possible);
      for (const size_t index : {size_t{0}, size_t{9}, size_t{15}}) {
        CHECK(sbus::stateOf(sealedWith(channel, index)) ==
              (row.possible ? StoredState::Good : StoredState::Impossible));
      }
    }
  }
}

TEST_CASE("all 2048 values lie within half a thousandth and half a microsecond of the lines after the dead zone") {
  for (const CalibratedChannel &sample : Samples) {
    for (const CalibratedChannel &channel : {sample, reversed(sample)}) {
      INFO("channel.range.low ", channel.range.low, ", channel.deadZone ", channel.deadZone);
      CHECK(isExact(channel));
      for (int raw = 0; raw < Values; raw++) {
        CAPTURE(raw);
        const auto value = static_cast<uint16_t>(raw);
        REQUIRE(std::abs(channel.toNormalized(value) - onTheLines(raw, channel, 0, 1000)) <= 0.5);
        REQUIRE(std::abs(channel.toMicroseconds(value) - onTheLines(raw, channel, 1500, 512)) <= 0.5);
        const bool dead = std::abs(raw - channel.range.centre) <= channel.deadZone;
        REQUIRE((!dead || (channel.toNormalized(value) == 0 && channel.toMicroseconds(value) == 1500)));
      }
    }
  }
}

TEST_CASE("a channel that is not calibrated is always at the centre; no channel, however odd, goes beyond 32767") {
  const CalibratedChannel odd[] = {
      {{0, 0, 0}, 0},
      {{65535, 0, 65535}, 0},
      {{0, 65535, 1}, 65535},
      {{65535, 32768, 0}, 32767},
      {{500, 1000, 700}, 65535},
      {{0, 1, 0}, 0},
  };
  for (const CalibratedChannel &channel : odd) {
    const bool empty = channel.range.centre == 0 && channel.range.high == 0;
    for (unsigned raw = 0; raw < 0x10000; raw++) {
      const int thousandths = channel.toNormalized(static_cast<uint16_t>(raw));
      const int us = channel.toMicroseconds(static_cast<uint16_t>(raw));
      if (thousandths < -32767 || us < -32767 || (empty && (thousandths != 0 || us != 1500))) {
        FAIL("channel.range.low ", channel.range.low, ", raw ", raw);
      }
    }
  }
}

TEST_CASE("all 2048 values lie within half a unit of the straight lines, clamped to 32767, and come back") {
  for (const auto &row : Ranges) {
    CAPTURE(row.name);
    for (int raw = 0; raw < Values; raw++) {
      CAPTURE(raw);
      const auto value = static_cast<uint16_t>(raw);
      const int16_t us = sbus::toMicroseconds(value, row.range);
      const int16_t thousandths = sbus::toNormalized(value, row.range);
      REQUIRE(std::abs(us - onTheLines(raw, {row.range, 0}, 1500, 512)) <= 0.5);
      REQUIRE(std::abs(thousandths - onTheLines(raw, {row.range, 0}, 0, 1000)) <= 0.5);
      if (std::abs(us) < 32767) {
        REQUIRE(std::abs(sbus::fromMicroseconds(us, row.range) - raw) <= 1);
      }
      if (std::abs(thousandths) < 32767 && row.isExact) {
        REQUIRE(sbus::fromNormalized(thousandths, row.range) == raw);
      }
    }
  }
}

TEST_CASE("a value without a raw value of its own becomes the nearest raw value") {
  const struct {
    int16_t us, thousandths;
    uint16_t raw;
  } rows[] = {{0, -2000, 0}, {INT16_MIN, INT16_MIN, 0}, {3000, 2000, 2047}, {INT16_MAX, INT16_MAX, 2047}};
  for (const auto &row : rows) {
    CAPTURE(row.us);
    CHECK(sbus::fromMicroseconds(row.us, sbus::FrSky) == row.raw);
    CHECK(sbus::fromNormalized(row.thousandths, sbus::FrSky) == row.raw);
  }
}

TEST_CASE("a side without length is the centre, and divides nothing by 0") {
  for (const sbus::Range &range : {sbus::Range{1000, 1000, 1000}, sbus::Range{1000, 1000, 2000}}) {
    CHECK(sbus::toMicroseconds(0, range) == 1500);
    CHECK(sbus::toNormalized(0, range) == 0);
    CHECK(sbus::toNormalized(1000, range) == 0);
    CHECK(sbus::fromNormalized(-1000, range) == 1000);
  }
  CHECK(sbus::toUnit(5, {7, 7, 7}) == 0);
}

TEST_CASE("limited() keeps values that are within its limits, and clamps others") {
  const struct {
    int32_t value;
    int16_t limited;
  } rows[] = {{INT32_MIN, -1000}, {-40000, -1000}, {40000, 1000}, {INT32_MAX, 1000}, {-1001, -1000},
              {-1000, -1000},     {-999, -999},    {0, 0},        {1000, 1000},      {1001, 1000}};
  for (const auto &row : rows) {
    CHECK(sbus::limited(row.value, -1000, 1000) == row.limited);
  }
  CHECK(sbus::limited(sbus::toNormalized(0, sbus::FrSky), -1000, 1000) == -1000);
  CHECK(sbus::toNormalized(0, sbus::FrSky) == -1210);  // (0 - 992) / 820: FrSky's "no pulses"
}

TEST_CASE("the paper's formula: -1 at low, +1 at high, and not quite 0 at a FrSky's centre") {
  CHECK(sbus::toUnit(172, sbus::FrSky) == doctest::Approx(-1));
  CHECK(sbus::toUnit(1811, sbus::FrSky) == doctest::Approx(1));
  CHECK(sbus::toUnit(992, sbus::FrSky) == doctest::Approx((992.0 - 172) / (1811 - 172) * 2 - 1));
  for (int raw = 0; raw < Values; raw++) {
    REQUIRE(std::abs(sbus::toUnit(static_cast<uint16_t>(raw), sbus::Futaba) - ((raw - 352.0) / 1344 * 2 - 1)) < 1e-6);
  }
}
