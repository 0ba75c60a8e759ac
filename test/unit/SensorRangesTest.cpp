// Values of sensors beyond what their slots can hold, and positions that no GPS has.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <limits>

#include "sbus2/Sensors.h"

namespace {

// Sends values of one field: of its type's ends, and around both ends of its range. Checks that encode() returns true
// within the range only, and that a decoder reads the nearest value there, in steps of `step`. Returns how many of them
// were out of range.
template <typename Sensor, typename Field>
int outOfRange(Field Sensor::*field, int64_t lowest, int64_t highest, int64_t step = 1) {
  using Limits = std::numeric_limits<Field>;
  int out = 0;
  for (const int64_t value :
       {int64_t{Limits::min()}, lowest - 1, lowest, highest, highest + 1, int64_t{Limits::max()}}) {
    if (value < Limits::min() || value > Limits::max()) {
      continue;  // the field cannot hold it
    }
    CAPTURE(value);
    const bool fits = value >= lowest && value <= highest;
    Sensor sensor = {};
    sensor.*field = static_cast<Field>(value);
    sbus::SlotData slots[Sensor::Slots];
    CHECK(sensor.encode(slots) == fits);
    sensor = {};
    sensor.decode(slots);
    const int64_t nearest = std::min(std::max(value, lowest), highest);
    CHECK(int64_t{sensor.*field} == nearest - nearest % step);
    out += !fits;
  }
  return out;
}

}  // namespace

TEST_CASE(
    "every field of every sensor: below the lowest and above the highest value the nearest is sent, and said so") {
  using namespace sbus;
  constexpr int64_t Lowest14 = -16384, Highest14 = 16383, Pole = 54000000, DateLine = 108000000;
  CHECK(outOfRange(&ReceiverVoltage::decivolts, 0, 1023) == 2);
  CHECK(outOfRange(&TemperatureSbs01T::degrees, -100, 32667) == 4);
  CHECK(outOfRange(&TemperatureF1713::degrees, Lowest14, Highest14) == 4);
  CHECK(outOfRange(&RotationSbs01R::rpm, 0, 393215, 6) == 2);
  CHECK(outOfRange(&VoltageSbs01V::batteryDecivolts, 0, 8191) == 2);
  CHECK(outOfRange(&VoltageSbs01V::externalDecivolts, 0, 8191) == 2);
  CHECK(outOfRange(&CurrentF1678::centiamperes, Lowest14, Highest14) == 4);
  CHECK(outOfRange(&CurrentF1678::centivolts, 0, 65535) == 0);
  CHECK(outOfRange(&CurrentF1678::milliampereHours, 0, 65535) == 0);
  CHECK(outOfRange(&VarioF1672::centimetresPerSecond, -32768, 32767) == 0);
  CHECK(outOfRange(&VarioF1672::metres, Lowest14, Highest14) == 4);
  CHECK(outOfRange(&VarioF1712::decimetresPerSecond, -32768, 32767) == 0);
  CHECK(outOfRange(&VarioF1712::metres, Lowest14, Highest14) == 4);
  CHECK(outOfRange(&AirSpeedSbs01Tas::kilometresPerHour, 0, 16383) == 2);
  CHECK(outOfRange(&GpsF1675::kilometresPerHour, 0, 16383) == 2);
  CHECK(outOfRange(&GpsF1675::metres, Lowest14, Highest14) == 4);
  CHECK(outOfRange(&GpsF1675::secondsOfDay, 0, 65535) == 0);
  CHECK(outOfRange(&GpsF1675::decimetresPerSecond, -32768, 32767) == 0);
  CHECK(outOfRange(&GpsF1675::latitude, -Pole, Pole) == 4);
  CHECK(outOfRange(&GpsF1675::longitude, -DateLine, DateLine) == 4);
  CHECK(outOfRange(&GpsSbs01G::secondsOfDay, 0, 131071) == 2);
  CHECK(outOfRange(&GpsSbs01G::latitude, -Pole, Pole) == 4);
  CHECK(outOfRange(&GpsSbs01G::longitude, -DateLine, DateLine) == 4);
  CHECK(outOfRange(&GpsSbs01G::kilometresPerHour, 0, 511) == 2);
  CHECK(outOfRange(&GpsSbs01G::satellites, 0, 3) == 2);
  CHECK(outOfRange(&GpsSbs01G::decapascals, 0, 16383) == 2);
  CHECK(outOfRange(&GpsSbs01G::decimetres, -8200, 57335) == 4);
  CHECK(outOfRange(&GpsSbs01G::decimetresPerSecond, -1500, 2595) == 4);
}

TEST_CASE("a GPS position with 60 minutes or more, or beyond the poles or the date line, is no fix") {
  const struct {
    const char *what;
    sbus::SlotData latitude[2], longitude[2];
    bool hasFix;
  } rows[] = {
      {"Berlin", {{52, 0x04}, {0xC4, 0xB3}}, {{13, 0x03}, {0xBF, 0x9A}}, true},
      {"Berlin in the south, as BrushlessPower sends it",
       {{52, 0x1F}, {0xC4, 0xB3}},
       {{13, 0x03}, {0xBF, 0x9A}},
       false},
      {"Berlin in the west, as BrushlessPower sends it", {{52, 0x04}, {0xC4, 0xB3}}, {{13, 0x1F}, {0xBF, 0x9A}}, false},
      {"59.9999 minutes", {{52, 0x09}, {0x27, 0xBF}}, {{13, 0x19}, {0x27, 0xBF}}, true},
      {"60 minutes north", {{52, 0x09}, {0x27, 0xC0}}, {{13, 0x03}, {0xBF, 0x9A}}, false},
      {"60 minutes west", {{52, 0x04}, {0xC4, 0xB3}}, {{13, 0x19}, {0x27, 0xC0}}, false},
      {"South Pole, date line", {{90, 0x10}, {0, 0}}, {{180, 0x00}, {0, 0}}, true},
      {"beyond the South Pole", {{90, 0x10}, {0, 1}}, {{180, 0x00}, {0, 0}}, false},
      {"beyond the date line", {{90, 0x10}, {0, 0}}, {{180, 0x10}, {0, 1}}, false},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    const sbus::SlotData slots[] = {{0x40, 0x32},    {0x40, 0x64},    {0xB0, 0xF0},     {0x00, 0x19},
                                    row.latitude[0], row.latitude[1], row.longitude[0], row.longitude[1]};
    sbus::GpsF1675 gps;
    gps.decode(slots);
    CHECK(gps.hasFix == row.hasFix);
    CHECK(gps.metres == 100);
  }
  // 26 and 27 bits hold more than the Earth has. Bytes by hand: latitude from bit 17, longitude from bit 44, fix: 81.
  const auto hasFix = [](uint64_t latitude, uint64_t longitude) {
    const uint64_t low = latitude << 17 | longitude << 44, high = longitude >> 20 | uint64_t{1} << (81 - 64);
    sbus::SlotData slots[8];
    for (unsigned i = 0; i < 8; i++) {
      const uint64_t word = (i < 4 ? low : high) >> (i % 4 * 16);
      slots[i] = {static_cast<uint8_t>(word), static_cast<uint8_t>(word >> 8)};
    }
    sbus::GpsSbs01G gps;
    gps.decode(slots);
    CHECK(gps.latitude == static_cast<int32_t>(latitude));
    CHECK(gps.longitude == static_cast<int32_t>(longitude));
    return gps.hasFix;
  };
  CHECK(hasFix(54000000, 108000000));
  CHECK(!hasFix(54000001, 108000000));
  CHECK(!hasFix(54000000, 108000001));
}
