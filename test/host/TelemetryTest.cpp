// The slots of a line's telemetry with their times, and what named sensors measure, as a text.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "line/Observer.h"
#include "line/telemetry/Readings.h"
#include "support/KnownFrames.h"

namespace {

struct Burst {
  uint64_t startUs;
  std::vector<uint8_t> bytes;
  int badAt = -1;  // index of a byte with a parity error
};

std::vector<uint8_t> frameBytes(unsigned number, uint8_t end) {
  const Frame frame = plainFrame(number, end);
  return {frame.begin(), frame.end()};
}

// Plays a line to an observer; `listen` is called with each stretch.
template <typename Listen>
std::string feed(const std::vector<Burst> &line, Listen listen) {
  line::Observer observer;
  observer.reset(0, line::CharacterUs);
  observer.listen([&](const line::Stretch &stretch) { listen(observer, stretch); });
  for (const Burst &burst : line) {
    for (size_t i = 0; i < burst.bytes.size(); i++) {
      line::Character character;
      character.endUs = burst.startUs + line::CharacterUs * (i + 1);
      character.value = burst.bytes[i];
      character.bad = burst.badAt == static_cast<int>(i);
      observer.put(character);
    }
  }
  observer.finish();
  return "rejected " + std::to_string(observer.telemetry().rejectedGroups());
}

// Returns "us slot:data0 data1" of each slot, and how many groups were rejected.
std::string read(const std::vector<Burst> &line) {
  std::string text;
  const std::string rejected = feed(line, [&text](const line::Observer &observer, const line::Stretch &) {
    for (const line::TimedSlot &slot : observer.telemetry().proved()) {
      text += std::to_string(slot.endUs) + " " + std::to_string(slot.number) + ":" + std::to_string(slot.data.data0) +
              "," + std::to_string(slot.data.data1) + " ";
    }
  });
  return text + rejected;
}

// Returns frames every 15 ms, each with what follows 2030 us after it.
std::string readBehind(uint8_t end, const std::vector<uint8_t> &behind, int badAt = -1) {
  std::vector<Burst> line;
  for (unsigned i = 0; i < 6; i++) {
    line.push_back({10000 + 15000 * i, frameBytes(i, end)});
    if (i == 2) {
      line.push_back({10000 + 15000 * i + 3000 + 2030, behind, badAt});
    }
  }
  return read(line);
}

std::string measured(const char *name, const std::vector<sbus::SlotData> &data) {
  const line::Sensor *const sensor = line::sensorOf(name);
  REQUIRE(sensor != nullptr);
  REQUIRE(sensor->slots == data.size());
  std::string text;
  for (const line::Quantity &quantity : sensor->quantities(data.data())) {
    text += (text.empty() ? "" : ", ") + std::to_string(quantity.slot) + " " + quantity.name + " " + quantity.value +
            " " + quantity.unit;
  }
  return text;
}

}  // namespace

TEST_CASE(
    "slots are read with the time of their last character; what is not just slots is rejected, and so is a "
    "character with an error") {
  // The third frame begins at 40 ms; slots begin at 45030 us.
  const struct {
    const char *what;
    uint8_t end;
    std::vector<uint8_t> behind;
    int badAt;
    const char *found;
  } rows[] = {
      {"the receiver", 0x04, {0x03, 0xC0, 0x2E}, -1, "45390 0:192,46 rejected 0"},
      {"an SBS-01V", 0x04, {0x83, 0x80, 0x38, 0x43, 0x00, 0x7D}, -1, "45390 1:128,56 45750 2:0,125 rejected 0"},
      {"an R7003SB", 0x08, {0x00, 0x03, 0xC0, 0x33, 0x00}, -1, "45510 0:192,51 rejected 0"},
      {"breaks",
       0x04,
       {0x00, 0x83, 0x80, 0x38, 0x00, 0x43, 0x00, 0x7D, 0x00},
       -1,
       "45510 1:128,56 45990 2:0,125 rejected 0"},
      {"a character with an error", 0x04, {0x83, 0x80, 0x38, 0x43, 0x00, 0x7D}, 4, "rejected 1"},
      {"a character is missing", 0x04, {0x83, 0x80, 0x43, 0x00, 0x7D}, -1, "rejected 1"},
      {"another group", 0x14, {0x83, 0x80, 0x38}, -1, "rejected 1"},
      {"a line without telemetry", 0x00, {0x03, 0xC0, 0x2E}, -1, "rejected 0"},
      {"more than a group", 0x04, std::vector<uint8_t>(34, 0x83), -1, "rejected 1"},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    CHECK(readBehind(row.end, row.behind, row.badAt) == row.found);
  }
}

TEST_CASE("sensors' quantities are right: the sources' examples and real lines") {
  CHECK(measured("receiver", {{0xC0, 0x2E}}) == "0 receiver voltage 4.6 V");
  CHECK(measured("receiver", {{0xC5, 0x04}}) == "0 external voltage 26.0 V");
  CHECK(measured("sbs-01t", {{0x5A, 0x80}}) == "0 temperature -10 degC");
  CHECK(measured("F1713", {{0xFF, 0xFB}}) == "0 temperature -5 degC");
  CHECK(measured("SBS-01R", {{0xD0, 0x07}}) == "0 rotation 12000 1/min");
  CHECK(measured("SBS-01V", {{0x80, 0x38}, {0x00, 0x7D}}) == "0 battery voltage 5.6 V, 1 external voltage 12.5 V");
  CHECK(measured("F1678", {{0x49, 0x29}, {0x04, 0xD2}, {0x05, 0xDC}}) ==
        "0 current 23.45 A, 1 voltage 12.34 V, 2 charge 1500 mAh");
  CHECK(measured("SBS-01C", {{0xFF, 0xFE}, {0x00, 0x05}, {0x00, 0x00}}) ==
        "0 current -0.02 A, 1 voltage 0.05 V, 2 charge 0 mAh");
  CHECK(measured("F1672", {{0xFF, 0x6A}, {0xFF, 0xEC}}) == "0 climb -1.50 m/s, 1 altitude -20 m");
  CHECK(measured("F1712", {{0x00, 0x19}, {0x49, 0xA4}}) == "0 climb 2.5 m/s, 1 altitude 2468 m");
  CHECK(measured("SBS-01TAS", {{0x40, 0x5A}}) == "0 air speed 90 km/h");
  CHECK(measured("F1675", {{0x40, 0x32},
                           {0x40, 0x64},
                           {0xB0, 0xF0},
                           {0x00, 0x19},
                           {0x34, 0x14},
                           {0xC4, 0xB3},
                           {0x0D, 0x03},
                           {0xBF, 0x9A}}) ==
        "0 speed 50 km/h, 1 altitude 100 m, 2 UTC 45296 s, 3 climb 2.5 m/s, 4 latitude -52.520832 deg, 6 longitude "
        "13.409430 deg");
  CHECK(measured("F1675", {{0x00, 0x32},
                           {0x40, 0x64},
                           {0xB0, 0xF0},
                           {0x00, 0x19},
                           {0x34, 0x14},
                           {0xC4, 0xB3},
                           {0x0D, 0x03},
                           {0xBF, 0x9A}}) == "1 altitude 100 m, 2 UTC 45296 s, 3 climb 2.5 m/s");
  CHECK(measured("SBS-01G", {{0xF0, 0xB0},
                             {0x66, 0xAF},
                             {0xC1, 0xA3},
                             {0x45, 0xAC},
                             {0x07, 0x32},
                             {0x8E, 0xF2},
                             {0x84, 0x1F},
                             {0xA9, 0xAF}}) ==
        "0 UTC 45296 s, 1 latitude 52.520832 deg, 3 longitude 13.409430 deg, 4 speed 50 km/h, 5 pressure 1013.2 hPa, 6 "
        "altitude 100.0 m, "
        "7 climb 2.5 m/s");
  CHECK(measured("SBS-01G", {{0, 0}, {0, 0}, {0, 0}, {0, 0}, {0, 0}, {0x60, 0xED}, {0xF4, 0x15}, {0xE1, 0xAE}}) ==
        "0 UTC 0 s, 5 pressure 1009.1 hPa, 6 altitude 69.4 m, 7 climb 0.0 m/s");
  CHECK(line::sensorOf("F167") == nullptr);
  CHECK(line::sensorOf("") == nullptr);
}

TEST_CASE("a stretch is named slots while only slots have come since the frame; a gap between two slots ends it") {
  const struct {
    const char *what;
    std::vector<Burst> behind;  // times from the end of the frame on
    const char *said;
  } rows[] = {
      {"slots 0 to 2", {{2030, {0x03, 0xC0, 0x2E}}, {2690, {0x83, 1, 2, 0x43, 3, 4}}}, "telemetry slots 0, 1, 2; "},
      {"breaks",
       {{0, {0x00}}, {2030, {0x03, 0xC0, 0x2E, 0x00}}, {2690, {0x83, 1, 2, 0x00}}},
       "no header; telemetry slots 0, 1; "},
      {"slots 0 and 6", {{2030, {0x03, 0xC0, 0x2E}}, {5990, {0x63, 1, 2}}}, "telemetry slot 0; telemetry slot 6; "},
      {"noise, then slot 6", {{2030, {0x55}}, {5990, {0x63, 1, 2}}}, "no header; no header; "},
      {"slot 6, then slot 0", {{2030, {0x63, 1, 2}}, {5990, {0x03, 0xC0, 0x2E}}}, "telemetry slot 6; no header; "},
      {"a character with an error", {{2030, {0x03, 0xC0, 0x2E}, 1}}, "parity or framing error (byte 1); "},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    std::vector<Burst> line = {
        {10000, frameBytes(0, 0x24)}, {25000, frameBytes(1, 0x34)}, {40000, frameBytes(2, 0x04)}};
    for (Burst burst : row.behind) {
      burst.startUs += 40000 + uint64_t{sbus::FrameSize} * line::CharacterUs;
      line.push_back(burst);
    }
    std::string said;
    line.push_back({55000, frameBytes(3, 0x14)});
    feed(line, [&](const line::Observer &, const line::Stretch &stretch) {
      said += stretch.characters.size() < sbus::FrameSize ? why(stretch) + "; " : "";
    });
    CHECK(said == row.said);
  }
}

TEST_CASE("readings have the newest of each quantity, both of the receiver's, and none of a sensor that lacks a slot") {
  using Slots = std::vector<line::TimedSlot>;
  line::Readings readings({{uint8_t{0}, line::sensorOf("receiver")}, {uint8_t{1}, line::sensorOf("SBS-01V")}});
  const auto texts = [&readings](uint64_t sinceUs) {
    std::string all;
    for (const std::string &text : readings.quantities(sinceUs)) {
      all += text + "; ";
    }
    return all + readings.slots(sinceUs);
  };
  CHECK(texts(0).empty());
  readings.put(Slots{{{0, {0xC0, 0x2E}}, 1000}});
  CHECK(texts(0) == "receiver voltage 4.6 V; slot 0");
  readings.put(Slots{{{0, {0xC4, 0xF1}}, 61000}, {{1, {0x80, 0x38}}, 61660}, {{2, {0x00, 0x7D}}, 62320}});
  readings.put(Slots{{{0, {0xC0, 0x2D}}, 121000}, {{1, {0x80, 0x39}}, 121660}});
  CHECK(
      texts(0) ==
      "external voltage 24.1 V; receiver voltage 4.5 V; battery voltage 5.6 V; external voltage 12.5 V; slots 0, 1, 2");
  CHECK(texts(121000) == "receiver voltage 4.5 V; slots 0, 1");
  CHECK(texts(121660) == "receiver voltage 4.5 V; slot 1");
  CHECK(texts(121661).empty());
  std::string numbers;
  readings.each(62320, [&numbers](const line::Quantity &quantity, double number) {
    numbers += std::to_string(quantity.slot) + " " + std::to_string(std::lround(10 * number)) + "; ";
  });
  CHECK(numbers == "0 241; 0 45; 1 56; 2 125; ");
}
