// The values of sensors from the data of their slots, and back: the sources' worked examples, every word, values beyond
// what slots can hold, and positions that no GPS has.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "sbus2/Sensors.h"

namespace {

using Data = std::vector<sbus::SlotData>;

template <typename Sensor>
Sensor decoded(const Data &data) {
  REQUIRE(data.size() == Sensor::Slots);
  Sensor sensor;
  sensor.decode(data.data());
  return sensor;
}

template <typename Sensor>
std::string encoded(const Sensor &sensor) {
  sbus::SlotData slots[Sensor::Slots];
  sensor.encode(slots);
  std::string text;
  for (const sbus::SlotData &slot : slots) {
    char word[8];
    std::snprintf(word, sizeof word, "%s%02X%02X", text.empty() ? "" : " ", slot.data0, slot.data1);
    text += word;
  }
  return text;
}

// Returns what a decoder reads of this.
template <typename Sensor>
Sensor readBack(const Sensor &sensor) {
  sbus::SlotData slots[Sensor::Slots];
  sensor.encode(slots);
  Sensor back = {};
  back.decode(slots);
  return back;
}

sbus::SlotData dataOf(unsigned word) { return {static_cast<uint8_t>(word >> 8), static_cast<uint8_t>(word)}; }

// Returns how many words are encoded from their own value.
template <typename Sensor>
unsigned wordsThatComeBack() {
  unsigned count = 0;
  for (unsigned word = 0; word <= 0xFFFF; word++) {
    const sbus::SlotData slot = dataOf(word);
    Sensor sensor;
    sensor.decode(&slot);
    sbus::SlotData again;
    sensor.encode(&again);
    count += again.data0 == slot.data0 && again.data1 == slot.data1;
  }
  return count;
}

}  // namespace

TEST_CASE("the receiver's voltage, PX4's capture and Kasai's and msrc's lines") {
  const struct {
    unsigned word;
    uint16_t decivolts;
    bool isExternal;
  } rows[] = {{0xC02E, 46, false}, {0xC4F1, 241, true}, {0xC504, 260, true}, {0xC400, 0, true}, {0xC7FF, 1023, true}};
  for (const auto &row : rows) {
    CAPTURE(row.word);
    const auto voltage = decoded<sbus::ReceiverVoltage>({dataOf(row.word)});
    CHECK(voltage.decivolts == row.decivolts);
    CHECK(voltage.isExternal == row.isExternal);
    sbus::SlotData slot;
    voltage.encode(&slot);
    CHECK((slot.data0 << 8 | slot.data1) == static_cast<int>(row.word));
  }
  CHECK(decoded<sbus::ReceiverVoltage>({{0xE0, 0x31}}).decivolts == 49);  // FASSTest 12CH
  CHECK(decoded<sbus::ReceiverVoltage>({{0x04, 0x00}}).decivolts == 0);   // R7003SB, radio off
}

TEST_CASE("sensors of one value: the sources' examples") {
  const struct {
    int16_t degrees;
    const char *sbs01t, *f1713;
  } temperatures[] = {
      {25, "7D80", "4019"}, {-10, "5A80", "FFF6"}, {300, "9081", "412C"}, {50, "9680", "4032"}, {-5, "5F80", "FFFB"}};
  for (const auto &row : temperatures) {
    CAPTURE(row.degrees);
    CHECK(encoded(sbus::TemperatureSbs01T{row.degrees}) == row.sbs01t);
    CHECK(encoded(sbus::TemperatureF1713{row.degrees}) == row.f1713);
  }
  CHECK(decoded<sbus::TemperatureSbs01T>({{0x5A, 0x80}}).degrees == -10);
  CHECK(decoded<sbus::TemperatureSbs01T>({{0x5A, 0x00}}).degrees == -10);  // BrushlessPower's, which lacks the flag
  CHECK(decoded<sbus::TemperatureF1713>({{0xFF, 0xFB}}).degrees == -5);
  CHECK(encoded(sbus::RotationSbs01R{3000}) == "F401");
  CHECK(encoded(sbus::RotationSbs01R{12000}) == "D007");
  CHECK(decoded<sbus::RotationSbs01R>({{0xFF, 0xFF}}).rpm == 393210);
  CHECK(encoded(sbus::AirSpeedSbs01Tas{90}) == "405A");
  CHECK(decoded<sbus::AirSpeedSbs01Tas>({{0x40, 0x5A}}).kilometresPerHour == 90);
}

TEST_CASE("sensors of several slots: a real SBS-01V, and the sources' examples") {
  const auto voltage = decoded<sbus::VoltageSbs01V>({{0x80, 0x38}, {0x00, 0x7D}});  // msrc#173: 5.6 V and 12.5 V
  CHECK(voltage.batteryDecivolts == 56);
  CHECK(voltage.externalDecivolts == 125);
  CHECK(encoded(voltage) == "8038 007D");

  const auto current = decoded<sbus::CurrentF1678>({{0x49, 0x29}, {0x04, 0xD2}, {0x05, 0xDC}});
  CHECK(current.centiamperes == 2345);
  CHECK(current.centivolts == 1234);
  CHECK(current.milliampereHours == 1500);
  CHECK(encoded(current) == "4929 04D2 05DC");

  const auto rising = decoded<sbus::VarioF1672>({{0x01, 0x02}, {0x49, 0xA4}});
  CHECK(rising.centimetresPerSecond == 258);
  CHECK(rising.metres == 2468);
  CHECK(encoded(rising) == "0102 49A4");
  const auto falling = decoded<sbus::VarioF1672>({{0xFF, 0x6A}, {0xFF, 0xEC}});
  CHECK(falling.centimetresPerSecond == -150);
  CHECK(falling.metres == -20);
  CHECK(encoded(falling) == "FF6A FFEC");

  const auto vario = decoded<sbus::VarioF1712>({{0x00, 0x19}, {0x49, 0xA4}});
  CHECK(vario.decimetresPerSecond == 25);
  CHECK(vario.metres == 2468);
  CHECK(encoded(vario) == "0019 49A4");
}

TEST_CASE("a GPS over Berlin: 52 31.2499 N, 13 24.5658 E, 50 km/h, 100 m, +2.5 m/s, 12:34:56") {
  sbus::GpsF1675 gps{50, true, 100, 45296, 25, 52 * 600000 + 312499, 13 * 600000 + 245658};
  CHECK(encoded(gps) == "4032 4064 B0F0 0019 3404 C4B3 0D03 BF9A");
  const auto again = decoded<sbus::GpsF1675>(
      {{0x40, 0x32}, {0x40, 0x64}, {0xB0, 0xF0}, {0x00, 0x19}, {0x34, 0x04}, {0xC4, 0xB3}, {0x0D, 0x03}, {0xBF, 0x9A}});
  CHECK(again.kilometresPerHour == 50);
  CHECK(again.hasFix);
  CHECK(again.metres == 100);
  CHECK(again.secondsOfDay == 45296);
  CHECK(again.decimetresPerSecond == 25);
  CHECK(again.latitude == 31512499);
  CHECK(again.longitude == 8045658);
  gps.latitude = -gps.latitude;
  gps.longitude = -gps.longitude;
  CHECK(encoded(gps) == "4032 4064 B0F0 0019 3414 C4B3 0D13 BF9A");
  CHECK(
      decoded<sbus::GpsF1675>({{0, 0}, {0, 0}, {0, 0}, {0, 0}, {0x34, 0x14}, {0xC4, 0xB3}, {0x0D, 0x13}, {0xBF, 0x9A}})
          .longitude == -8045658);

  const sbus::GpsSbs01G big{45296, 31512499, 8045658, 50, true, 3, 10132, 1000, 25, true};
  CHECK(encoded(big) == "F0B0 66AF C1A3 45AC 0732 8EF2 841F A9AF");
  const auto real = decoded<sbus::GpsSbs01G>(  // the last three slots of a real sensor without a fix
      {{0, 0}, {0, 0}, {0, 0}, {0, 0}, {0, 0}, {0x60, 0xED}, {0xF4, 0x15}, {0xE1, 0xAE}});
  CHECK(!real.hasFix);
  CHECK(real.decapascals == 10091);
  CHECK(real.decimetres == 694);
  CHECK(real.decimetresPerSecond == 0);
  CHECK(real.hasPressure);
}

TEST_CASE("every word that a sensor may send is decoded and encoded as the same word") {
  CHECK(wordsThatComeBack<sbus::ReceiverVoltage>() == 0x800);     // of eight upper bits one pattern
  CHECK(wordsThatComeBack<sbus::TemperatureSbs01T>() == 0x8000);  // with the flag
  CHECK(wordsThatComeBack<sbus::TemperatureF1713>() == 0x8000);   // 14 bits with the flag, and negative ones
  CHECK(wordsThatComeBack<sbus::RotationSbs01R>() == 0x10000);
  CHECK(wordsThatComeBack<sbus::AirSpeedSbs01Tas>() == 0x4000);
}

TEST_CASE("every value in its range comes back from its slots: temperature, current, climb, altitude, angles") {
  for (int value = -16384; value <= 16383; value++) {
    const auto number = static_cast<int16_t>(value);
    const auto mine = static_cast<uint16_t>(3 * value);
    REQUIRE(readBack(sbus::TemperatureF1713{number}).degrees == value);
    const sbus::CurrentF1678 current = readBack(sbus::CurrentF1678{number, mine, mine});
    REQUIRE(current.centiamperes == value);
    REQUIRE(current.centivolts == mine);
    REQUIRE(current.milliampereHours == mine);
    const sbus::VarioF1672 vario = readBack(sbus::VarioF1672{static_cast<int16_t>(2 * value), number});
    REQUIRE(vario.centimetresPerSecond == 2 * value);
    REQUIRE(vario.metres == value);
    const int32_t latitude = 3295 * value, longitude = 6591 * value;  // up to 89 and 179 degrees, on both sides
    const sbus::GpsF1675 gps = readBack(
        sbus::GpsF1675{static_cast<uint16_t>(value & 0x3FFF), value > 0, number, mine, number, latitude, longitude});
    REQUIRE(gps.latitude == latitude);
    REQUIRE(gps.longitude == longitude);
    REQUIRE(gps.kilometresPerHour == (value & 0x3FFF));
    REQUIRE(gps.hasFix == (value > 0));
    REQUIRE(gps.metres == value);
    REQUIRE(gps.decimetresPerSecond == value);
    const auto height = static_cast<int16_t>(value < -8200 ? value + 8192 : value);
    const sbus::GpsSbs01G sent{static_cast<uint32_t>(value & 0x1FFFF),
                               latitude,
                               longitude,
                               static_cast<uint16_t>(value & 0x1FF),
                               value > 0,
                               static_cast<uint8_t>(value & 3),
                               static_cast<uint16_t>(value & 0x3FFF),
                               height,
                               static_cast<int16_t>((value & 0xFFF) - 1500),
                               value < 0};
    const sbus::GpsSbs01G big = readBack(sent);
    REQUIRE(big.secondsOfDay == sent.secondsOfDay);
    REQUIRE(big.latitude == latitude);
    REQUIRE(big.longitude == longitude);
    REQUIRE(big.kilometresPerHour == sent.kilometresPerHour);
    REQUIRE(big.hasFix == sent.hasFix);
    REQUIRE(big.satellites == sent.satellites);
    REQUIRE(big.decapascals == sent.decapascals);
    REQUIRE(big.decimetres == height);
    REQUIRE(big.decimetresPerSecond == sent.decimetresPerSecond);
    REQUIRE(big.hasPressure == sent.hasPressure);
  }
}

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
