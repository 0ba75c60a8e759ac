// The simulated S.BUS2 wire: what its receiver and sensors send and when, what happens to characters that collide, and
// how it judges a board that sends.
#include <doctest/doctest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "line/Observer.h"
#include "line/simulation/SimulatedBus.h"
#include "line/telemetry/FutabaSensors.h"

namespace {

using line::BusMode;
using line::Character;
using line::SimulatedBus;

constexpr uint64_t FirstFrameUs = 5000;
constexpr uint32_t FrameUs = 25 * line::CharacterUs;
constexpr uint32_t PeriodUs = 15000;

// Reads the wire up to `untilUs`, in steps of 50 us, as a port does that looks a character ahead.
std::vector<Character> heard(SimulatedBus &bus, uint64_t untilUs) {
  std::vector<Character> all;
  for (uint64_t nowUs = 0; nowUs <= untilUs; nowUs += 50) {
    Character character;
    while (bus.next(nowUs + line::CharacterUs, character)) {
      CHECK(character.endUs <= nowUs);
      all.push_back(character);
    }
  }
  return all;
}

// "start of the run in us: its bytes" of each run of characters that is no frame; "!" after a character with an error.
std::string runs(const std::vector<Character> &characters) {
  std::string text;
  uint64_t lastUs = 0;
  for (size_t i = 0; i < characters.size();) {
    size_t size = 1;
    while (i + size < characters.size() && characters[i + size].endUs <= characters[i + size - 1].endUs + 130) {
      size++;
    }
    if (size != sbus::FrameSize) {
      text += text.empty() ? "" : "; ";
      text += std::to_string(characters[i].endUs - line::CharacterUs - lastUs) + ":";
      for (size_t at = i; at < i + size; at++) {
        text += " " + std::to_string(characters[at].value) + (characters[at].bad ? "!" : "");
      }
    }
    i += size;
    lastUs = characters[i - 1].endUs;
  }
  return text;
}

// The board sends `bytes`, so long after the end of frame `frame`, and the wire is heard to the end of the next frame.
std::string judged(BusMode mode, unsigned frame, int64_t afterUs, const std::vector<uint8_t> &bytes,
                   const std::vector<line::BusSensor> &sensors = {}, const line::LineSettings &tx = {}) {
  SimulatedBus bus(line::Flight, mode);
  for (const line::BusSensor &sensor : sensors) {
    bus.add(sensor);
  }
  bus.share(tx);
  const uint32_t periodUs = mode == BusMode::OnlySlot0 ? 6300 : PeriodUs;
  const uint64_t startUs =
      static_cast<uint64_t>(static_cast<int64_t>(FirstFrameUs + frame * uint64_t{periodUs} + FrameUs) + afterUs);
  size_t sent = 0;
  for (uint64_t nowUs = 0; nowUs <= startUs + 2 * periodUs; nowUs += 10) {
    for (; sent < bytes.size() && startUs + sent * line::CharacterUs <= nowUs; sent++) {
      Character character;
      character.endUs = startUs + (sent + 1) * line::CharacterUs;
      character.value = bytes[sent];
      bus.hear(character);
    }
    Character character;
    while (bus.next(nowUs + line::CharacterUs, character)) {
    }
  }
  return bus.judge().text();
}

}  // namespace

TEST_CASE(
    "the receiver sends a frame every 15 ms, end bytes 04 14 24 34 in turn, and in slot 0 both voltages in turn") {
  SimulatedBus bus;
  line::Observer observer;
  std::string ends, voltages;
  observer.reset(0, line::CharacterUs);
  observer.listen([&](const line::Stretch &stretch) {
    if (stretch.kind == line::Stretch::Kind::Frame) {
      ends += std::to_string(stretch.characters.back().value >> 4);
      CHECK((stretch.characters.back().value & 0x0F) == 4);
    }
    for (const line::TimedSlot &slot : observer.telemetry().proved()) {
      const line::Quantity quantity = line::sensorOf("receiver")->quantities(&slot.data)[0];
      voltages += std::string(quantity.name) + " " + quantity.value + " at " + std::to_string(slot.endUs) + "; ";
    }
  });
  for (const Character &character : heard(bus, FirstFrameUs + 9 * PeriodUs)) {
    observer.put(character);
  }
  observer.finish();
  CHECK(ends.substr(0, 8) == "01230123");
  // The first frame ends at 8000 us.
  CHECK(voltages == "receiver voltage 4.6 at 10390; external voltage 24.1 at 70390; ");
  CHECK(observer.telemetry().rejectedGroups() == 0);
  CHECK(bus.report().empty());
}

TEST_CASE("FASSTest 12CH has slot 0 after 310 us, and a plain receiver has no slots") {
  SimulatedBus only(line::Flight, BusMode::OnlySlot0);
  CHECK(runs(heard(only, FirstFrameUs + 6300)) == "310: 3 192 46");
  SimulatedBus none(line::Flight, BusMode::NoTelemetry);
  CHECK(runs(heard(none, FirstFrameUs + PeriodUs)).empty());
}

TEST_CASE("sensors answer in their slots, early or late; two at once destroy each other's characters") {
  const struct {
    std::vector<line::BusSensor> sensors;
    const char *runs;
  } rows[] = {
      {{{2, {1, 2}}}, "2030: 3 192 46; 960: 67 1 2"},
      {{{1, {1, 2}, 100}, {7, {3, 4}, -100}}, "2030: 3 192 46; 400: 131 1 2; 3400: 227 3 4"},
      {{{2, {1, 2}}, {2, {1, 2}}}, "2030: 3 192 46; 960: 67! 67! 1! 1! 2! 2!"},
      {{{2, {1, 2}}, {2, {1, 2}, 100}}, "2030: 3 192 46; 960: 67! 67! 1! 1! 2! 2!"},
      {{{3, {1, 2}, -1980}}, "2030: 3! 195! 192! 1! 46! 2!"},
      {{{9, {1, 2}}}, "2030: 3 192 46"},
  };
  for (const auto &row : rows) {
    SimulatedBus bus;
    for (const line::BusSensor &sensor : row.sensors) {
      bus.add(sensor);
    }
    CHECK(runs(heard(bus, FirstFrameUs + PeriodUs)) == row.runs);
  }
}

TEST_CASE("a board that sends is judged by slot, time, and what the frame before announced") {
  const std::vector<uint8_t> slot1 = {0x83, 1, 2};
  const std::vector<uint8_t> slot9 = {0x93, 1, 2};
  const std::vector<uint8_t> slot0 = {0x03, 1, 2};
  constexpr int64_t Due = line::FirstSlotUs + line::SlotPitchUs;  // of slots 1, 9, 17, 25
  constexpr int64_t BehindUs = PeriodUs - FrameUs;                // the next frame begins
  line::LineSettings uninverted;
  uninverted.polarity = line::Polarity::Uninverted;
  line::LineSettings slow;
  slow.baud = 9600;
  const struct {
    const char *what;
    std::string found;
    const char *expected;
  } rows[] = {
      {"on time", judged(BusMode::Slots, 0, Due, slot1), "1 answers in their slots, 0..0 us off"},
      {"50 us late", judged(BusMode::Slots, 0, Due + 50, slot1), "1 answers in their slots, 50..50 us off"},
      {"50 us early", judged(BusMode::Slots, 0, Due - 50, slot1), "1 answers in their slots, -50..-50 us off"},
      {"51 us late", judged(BusMode::Slots, 0, Due + 51, slot1), "0 answers in their slots; 1 late"},
      {"51 us early", judged(BusMode::Slots, 0, Due - 51, slot1), "0 answers in their slots; 1 early"},
      {"the second group", judged(BusMode::Slots, 1, Due, slot9), "1 answers in their slots, 0..0 us off"},
      {"the wrong group", judged(BusMode::Slots, 1, Due, slot1), "0 answers in their slots; 1 not announced"},
      {"no group", judged(BusMode::NoTelemetry, 0, Due, slot1), "0 answers in their slots; 1 not announced"},
      {"12CH", judged(BusMode::OnlySlot0, 0, Due, slot1), "0 answers in their slots; 1 not announced"},
      {"slot 0", judged(BusMode::Slots, 1, Due, slot0), "0 answers in their slots; 1 in slot 0"},
      {"two characters", judged(BusMode::Slots, 0, Due, {0x83, 1}), "0 answers in their slots; 1 cut short"},
      {"two late characters", judged(BusMode::Slots, 0, Due + 51, {0x83, 1}), "0 answers in their slots; 1 late"},
      {"two others", judged(BusMode::Slots, 0, Due, {0x84, 1}), "0 answers in their slots; 1 torn"},
      {"four characters", judged(BusMode::Slots, 0, Due, {0x83, 1, 2, 3}), "0 answers in their slots; 1 torn"},
      {"no slot's ID", judged(BusMode::Slots, 0, Due, {0x84, 1, 2}), "0 answers in their slots; 1 torn"},
      {"over the receiver", judged(BusMode::Slots, 0, Due - 500, slot1), "0 answers in their slots; 1 collided"},
      {"over a sensor", judged(BusMode::Slots, 0, Due, slot1, {{1, {1, 2}}}), "0 answers in their slots; 1 collided"},
      {"over a frame", judged(BusMode::Slots, 0, -500, slot1), "0 answers in their slots; 1 collided"},
      {"a frame begins within it", judged(BusMode::Slots, 0, BehindUs - 359, slot1),
       "0 answers in their slots; 1 met by a frame"},
      {"as it does", judged(BusMode::Slots, 0, BehindUs, slot1), "0 answers in their slots; 1 met by a frame"},
      {"just after a frame begins", judged(BusMode::Slots, 0, BehindUs + 169, slot1),
       "0 answers in their slots; 1 in a frame's first character"},
      {"later", judged(BusMode::Slots, 0, BehindUs + 170, slot1), "0 answers in their slots; 1 collided"},
      {"held", judged(BusMode::Slots, 0, Due, {}, {}, uninverted),
       "0 answers in their slots; 1 while TX held the wire"},
      {"slow", judged(BusMode::Slots, 0, Due, slot1, {}, slow), "0 answers in their slots; 1 collided"},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    CHECK(row.found == row.expected);
  }
}

TEST_CASE("frames come at the intervals that pace() gives, each with its slots") {
  SimulatedBus bus;
  uint32_t calls = 0;
  bus.pace([&] { return ++calls == 2 ? 8000u : 20000u; });
  bus.add({9, {1, 2}});
  std::string starts;
  uint64_t lastUs = 0;
  for (const Character &character : heard(bus, 70000)) {
    const uint64_t startUs = character.endUs - line::CharacterUs;
    starts += startUs > lastUs + 1 ? std::to_string(startUs) + ":" + std::to_string(character.value) + " " : "";
    lastUs = character.endUs;
  }
  CHECK(starts == "5000:15 10030:3 25000:15 30690:147 33000:15 53000:15 ");
}

TEST_CASE("a TX that is HIGH while idle destroys every character on the wire") {
  SimulatedBus bus;
  line::LineSettings uninverted;
  uninverted.polarity = line::Polarity::Uninverted;
  bus.share(uninverted);
  const std::vector<Character> all = heard(bus, FirstFrameUs + PeriodUs);
  CHECK(all.size() == 28);
  for (const Character &character : all) {
    CHECK(character.bad);
  }
}
