// Raw values become microseconds and parts of the stick's travel, and come back: exactly, over all 2048 values.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "support/CalibrationRules.h"

namespace {

constexpr int Values = 2048;

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
              {-1000, -1000},     {-999, -999}, {0, 0}, {1000, 1000}, {1001, 1000}};
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
