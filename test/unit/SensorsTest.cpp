// The values of sensors from the data of their slots, and back: the sources' worked examples, and every word.
#include <doctest/doctest.h>

#include <cstdint>
#include <cstdio>
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

sbus::SlotData dataOf(unsigned word) {
  return {static_cast<uint8_t>(word >> 8), static_cast<uint8_t>(word)};
}

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
    const sbus::GpsF1675 gps =
        readBack(sbus::GpsF1675{static_cast<uint16_t>(value & 0x3FFF), value > 0, number, mine, number, latitude, longitude});
    REQUIRE(gps.latitude == latitude);
    REQUIRE(gps.longitude == longitude);
    REQUIRE(gps.kilometresPerHour == (value & 0x3FFF));
    REQUIRE(gps.hasFix == (value > 0));
    REQUIRE(gps.metres == value);
    REQUIRE(gps.decimetresPerSecond == value);
    const auto height = static_cast<int16_t>(value < -8200 ? value + 8192 : value);
    const sbus::GpsSbs01G sent{static_cast<uint32_t>(value & 0x1FFFF), latitude, longitude,
                               static_cast<uint16_t>(value & 0x1FF), value > 0, static_cast<uint8_t>(value & 3),
                               static_cast<uint16_t>(value & 0x3FFF), height,
                               static_cast<int16_t>((value & 0xFFF) - 1500), value < 0};
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
