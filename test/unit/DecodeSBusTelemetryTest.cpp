// DecodeSBusTelemetry on an S.BUS2 line: sensors are read in any loop, and their values grow old when they fall silent.
#include <doctest/doctest.h>

#include <cstdint>
#include <functional>

#include "support/Bytes.h"
#include "support/KnownFrames.h"
#include "support/UartPort.h"

// After Arduino.h.
#include <DecodeSBusTelemetry.h>

namespace {

constexpr uint32_t PeriodUs = 15000;
constexpr uint32_t ToSlotsUs = 2030;  // from the frame's end: PX4's capture
constexpr uint32_t PitchUs = 660;

struct Answer {
  uint8_t slot;
  Bytes characters;
};

// A receiver with an SBS-01V in slots 1 and 2 and a CURR-F1678 in 24 to 26; a test may change what they send.
struct Bus {
  bool hasBreaks = false;  // 00 after the frame and after each answer
  std::function<void(unsigned round, std::vector<Answer> &)> change = [](unsigned, std::vector<Answer> &) {};

  std::vector<Answer> answers(unsigned group, unsigned round) const {
    std::vector<Answer> all;
    if (group == 0) {
      all = {{0, {0x03, static_cast<uint8_t>(round % 2 == 0 ? 0xC0 : 0xC4), 0x2E}},  // 4.6 V, PX4's capture
             {1, {0x83, 0x80, 0x38}},                                                // 5.6 V, msrc#173
             {2, {0x43, 0x00, 0x7D}}};                                               // 12.5 V
    } else if (group == 3) {
      all = {{24, {0x1B, 0x49, 0x29}}, {25, {0x9B, 0x04, 0xD2}}, {26, {0x5B, 0x05, 0xDC}}};  // BrushlessPower
    }
    change(round, all);
    return all;
  }
};

// A sensor that the user has defined.
template <uint8_t Count>
struct Raw {
  static constexpr uint8_t Slots = Count;
  uint8_t data0 = 0;  // of the first slot
  void decode(const sbus::SlotData *slots) { data0 = slots[0].data0; }
};

template <uint8_t Count>
bool hasSlots(DecodeSBusTelemetry &sbus, uint8_t first) {
  Raw<Count> raw;
  return sbus.readSensor(first, raw);
}

// Returns data0 of a slot that must have come.
unsigned data0Of(DecodeSBus2 &sbus, uint8_t slot) {
  Raw<1> raw;
  REQUIRE(sbus.readSensor(slot, raw));
  return raw.data0;
}

// A sketch with a loop of some period, and the line that it reads.
struct Sketch {
  UartPort port;
  DecodeSBusTelemetry sbus{port};
  uint32_t loopUs;
  uint64_t loopedUs;

  explicit Sketch(uint32_t loop, const Driver &driver = Board)
      : port(sbus::Baud, driver), loopUs(loop), loopedUs(fakeMicros) {
    sbus.begin();
  }

  void runTo(uint64_t us) {
    for (; loopedUs + loopUs <= us; loopedUs += loopUs) {
      fakeMicros = loopedUs + loopUs;
      port.advance(fakeMicros);
      sbus.parseSBusFrame();
    }
  }

  void hear(uint64_t startUs, const Bytes &bytes) {
    for (size_t i = 0; i < bytes.size(); i++) {
      line::Character character;
      character.endUs = startUs + 120 * (i + 1);
      character.value = bytes[i];
      runTo(character.endUs);
      port.receive(character);
    }
  }

  // Runs for this many rounds of four frames each, 60 ms.
  void rounds(unsigned count, const Bus &bus = {}) {
    for (unsigned round = 0; round < count; round++) {
      for (unsigned group = 0; group < 4; group++) {
        const uint64_t startUs = nextUs;
        nextUs += PeriodUs;
        const Bytes behind(bus.hasBreaks ? 1 : 0, 0x00);
        hear(startUs, bytesOf(plainFrame(frames++, static_cast<uint8_t>(group << 4 | 4))) + behind);
        for (const Answer &answer : bus.answers(group, round)) {
          hear(startUs + 25 * 120 + ToSlotsUs + PitchUs * (answer.slot % 8), answer.characters + behind);
        }
        runTo(nextUs - 1);
      }
    }
  }

  uint64_t nextUs = fakeMicros + 20000;
  unsigned frames = 0;
};

bool hasVoltage(Sketch &sketch) {
  sbus::VoltageSbs01V voltage{4711, 4711};
  const bool has = sketch.sbus.readSensor(1, voltage);
  CHECK(voltage.batteryDecivolts == (has ? 56 : 4711));
  CHECK(voltage.externalDecivolts == (has ? 125 : 4711));
  return has;
}

bool hasCurrent(Sketch &sketch) {
  sbus::CurrentF1678 current{4711, 4711, 4711};
  const bool has = sketch.sbus.readSensor(24, current);
  CHECK(current.centiamperes == (has ? 2345 : 4711));
  CHECK(current.centivolts == (has ? 1234 : 4711));
  CHECK(current.milliampereHours == (has ? 1500 : 4711));
  return has;
}

}  // namespace

TEST_CASE("in loops of 50 us to 4.9 ms, on every driver, all sensors are read, no group is rejected, no frame missed") {
  for (const Driver &driver : {Board, ByteByByte, Esp32Told, Esp32}) {
    for (const uint32_t loopUs : {50u, 500u, 1000u, 3000u, 4900u}) {
      INFO(driver.name, ", loopUs ", loopUs);
      Sketch sketch(loopUs, driver);
      CHECK(!hasVoltage(sketch));
      sketch.rounds(10);
      CHECK(hasVoltage(sketch));
      CHECK(hasCurrent(sketch));
      sbus::ReceiverVoltage receiver;
      REQUIRE(sketch.sbus.readSensor(0, receiver));
      CHECK(receiver.decivolts == 46);
      CHECK(receiver.isExternal);  // the tenth round's
      CHECK(sketch.sbus.rejectedGroups() == 0);
      CHECK(sketch.sbus.counters().frames >= 39);
      CHECK(sketch.sbus.counters().resyncs == 0);
      for (const uint8_t empty : std::initializer_list<uint8_t>{3, 8, 16, 23, 27, 31}) {
        CHECK(!hasSlots<1>(sketch.sbus, empty));
      }
      CHECK(!hasSlots<2>(sketch.sbus, 2));  // slot 3 is empty
      CHECK(!hasSlots<2>(sketch.sbus, 31));
      CHECK(!hasSlots<1>(sketch.sbus, 200));
    }
  }
}

TEST_CASE(
    "a Futaba R7008SB sends a 00 after each transmission: all is read as without, with all slots in use as well") {
  for (const bool areAll : {false, true}) {
    for (const Driver &driver : {Board, ByteByByte, Esp32Told, Esp32}) {
      for (const uint32_t loopUs : {50u, 1000u, 3000u, 4000u, 4900u}) {
        INFO(driver.name, ", loopUs ", loopUs, ", areAll ", areAll);
        Sketch sketch(loopUs, driver);
        Bus bus;
        bus.hasBreaks = true;
        bus.change = [areAll](unsigned, std::vector<Answer> &answers) {
          for (uint8_t slot = 3; areAll && slot < 8 && answers.size() >= 3 && answers[0].slot == 0; slot++) {
            answers.push_back({slot, {sbus::slotId(slot), 0x00, slot}});
          }
        };
        sketch.rounds(10, bus);
        CHECK(hasVoltage(sketch));
        CHECK(hasCurrent(sketch));
        CHECK(hasSlots<8>(sketch.sbus, 0) == areAll);
        CHECK(sketch.sbus.rejectedGroups() == 0);
        CHECK(sketch.sbus.counters().frames >= 38);
        CHECK(sketch.sbus.counters().resyncs == 0);
      }
    }
  }
}

TEST_CASE(
    "on a line with breaks a slot that lacks a character costs no other slot, and other receivers are read in a "
    "second") {
  for (size_t lost = 0; lost < sbus::SlotSize; lost++) {
    CAPTURE(lost);
    Sketch sketch(1000);
    Bus bus;
    bus.hasBreaks = true;
    sketch.rounds(5, bus);
    bus.change = [lost](unsigned, std::vector<Answer> &answers) {
      if (answers.size() == 3 && answers[0].slot == 0) {
        answers[1].characters[1] = 0x81;
        answers[2].characters[1] = 0x99;  // a value that must not be read
        answers[2].characters.erase(answers[2].characters.begin() + static_cast<std::ptrdiff_t>(lost));
      }
    };
    sketch.rounds(3, bus);
    CHECK(data0Of(sketch.sbus, 1) == (lost == 0 ? 0x80 : 0x81));  // what follows without an ID may belong to slot 1
    CHECK(data0Of(sketch.sbus, 2) == 0x00);
    CHECK(hasCurrent(sketch));
    CHECK(sketch.sbus.rejectedGroups() == 3);
  }
  Sketch sketch(1000);
  Bus bus;
  bus.hasBreaks = true;
  sketch.rounds(5, bus);
  sketch.rounds(20);
  CHECK(hasVoltage(sketch));
  CHECK(sketch.sbus.rejectedGroups() > 0);
  const uint32_t rejected = sketch.sbus.rejectedGroups();
  sketch.rounds(5);
  CHECK(sketch.sbus.rejectedGroups() == rejected);
}

TEST_CASE("a sensor that falls silent is read for 16 more rounds, a second, and again when it comes back") {
  Sketch sketch(1000);
  Bus bus;
  sketch.rounds(5, bus);
  CHECK(hasVoltage(sketch));
  bus.change = [](unsigned, std::vector<Answer> &answers) {
    if (answers.size() == 3 && answers[0].slot == 0) {
      answers.pop_back();  // slot 2 of the SBS-01V
    }
  };
  for (unsigned round = 1; round <= 20; round++) {
    CAPTURE(round);
    sketch.rounds(1, bus);
    CHECK(hasVoltage(sketch) == (round <= sbus::Telemetry::MissesMax));
    CHECK(hasCurrent(sketch));
  }
  bus.change = [](unsigned, std::vector<Answer> &) {};
  sketch.rounds(1, bus);
  CHECK(hasVoltage(sketch));
  CHECK(sketch.sbus.rejectedGroups() == 0);
}

TEST_CASE(
    "a group that is not just slots is counted, and only slots that are certainly whole are read: a character missing "
    "or "
    "too many, two sensors in a slot") {
  const struct {
    const char *what;
    std::function<void(std::vector<Answer> &)> change;
    bool isSlot1Read, isSlot2Read;
  } rows[] = {
      {"data1 of slot 1 is missing", [](std::vector<Answer> &answers) { answers[1].characters.pop_back(); }, false,
       true},
      {"the ID of slot 1 is missing",
       [](std::vector<Answer> &answers) { answers[1].characters.erase(answers[1].characters.begin()); }, false, true},
      {"data0 of slot 2 is missing",
       [](std::vector<Answer> &answers) { answers[2].characters.erase(answers[2].characters.begin() + 1); }, true,
       false},
      {"a stray 55 after slot 2", [](std::vector<Answer> &answers) { answers[2].characters.push_back(0x55); }, true,
       false},
      {"slot 1 sends slot 2's ID", [](std::vector<Answer> &answers) { answers[1].characters[0] = 0x43; }, false, true},
      {"slot 1 sends an ID of group 1", [](std::vector<Answer> &answers) { answers[1].characters[0] = 0x93; }, false,
       true},
      {"nothing is whole", [](std::vector<Answer> &answers) { answers[1].characters = answers[2].characters = {0x43}; },
       false, false},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    Sketch sketch(1000);
    Bus bus;
    sketch.rounds(5, bus);
    bus.change = [&row](unsigned, std::vector<Answer> &answers) {
      if (answers.size() == 3 && answers[0].slot == 0) {
        answers[1].characters[1] = 0x99;
        answers[2].characters[1] = 0x99;
        row.change(answers);
      }
    };
    sketch.rounds(3, bus);
    CHECK(data0Of(sketch.sbus, 0) == 0xC0);
    CHECK((data0Of(sketch.sbus, 1) == 0x99) == row.isSlot1Read);
    CHECK((data0Of(sketch.sbus, 2) == 0x99) == row.isSlot2Read);
    CHECK(hasCurrent(sketch));
    CHECK(sketch.sbus.rejectedGroups() == 3);
  }
}

TEST_CASE("a sensor's age and how often it has come in a row with the same data are told, and follow what comes") {
  const auto trustOf = [](Sketch &sketch, uint8_t slot) {
    Raw<1> raw;
    sbus::Trust trust = {4711, 47};
    if (!sketch.sbus.readSensor(slot, raw, trust)) {
      CHECK(trust.age == 4711);
      CHECK(trust.times == 47);
    }
    return trust;
  };
  Sketch sketch(1000);
  Bus bus;
  CHECK(trustOf(sketch, 1).times == 47);
  sketch.rounds(2, bus);                       // the line's first frame is not found
  for (int times = 1; times <= 10; times++) {  // each time just before the next round's first frame
    CAPTURE(times);
    CHECK(trustOf(sketch, 1).times == (times < 8 ? times : 8));
    CHECK(trustOf(sketch, 1).age == 45 + 11);  // announced three frames before the newest, which is 11 ms old
    sketch.rounds(1, bus);
  }
  CHECK(trustOf(sketch, 24).age == 60 + 11);
  sketch.rounds(2, bus);
  CHECK(trustOf(sketch, 0).times == 1);  // the receiver's two voltages in turn
  sbus::CurrentF1678 current;
  sbus::Trust trust;
  REQUIRE(sketch.sbus.readSensor(24, current, trust));
  CHECK(trust.age == 60 + 11);
  CHECK(trust.times == 8);
  bool isSlot1 = true;
  bus.change = [&isSlot1](unsigned, std::vector<Answer> &answers) {
    if (answers.size() == 3 && answers[0].slot == 0) {
      answers[2].characters[1] = 0x99;
      if (!isSlot1) {
        answers.erase(answers.begin() + 1);
      }
    }
  };
  isSlot1 = false;
  sketch.rounds(3, bus);
  CHECK(trustOf(sketch, 1).age == 3 * 60 + 45 + 11);  // it is missing
  CHECK(trustOf(sketch, 1).times == 8);
  CHECK(trustOf(sketch, 2).age == 45 + 11);  // it has changed
  CHECK(trustOf(sketch, 2).times == 3);
  isSlot1 = true;
  sketch.rounds(1, bus);
  sbus::VoltageSbs01V voltage;
  REQUIRE(sketch.sbus.readSensor(1, voltage, trust));
  CHECK(trust.age == 45 + 11);
  CHECK(trust.times == 4);
}

TEST_CASE("the slots of a sensor change together: while one of them is damaged, all keep their values") {
  Sketch sketch(1000);
  Bus bus;
  sketch.rounds(5, bus);
  CHECK(hasVoltage(sketch));
  bus.change = [](unsigned, std::vector<Answer> &answers) {
    if (answers.size() == 3 && answers[0].slot == 0) {
      answers[1].characters[1] = 0x99;
      answers[2].characters.erase(answers[2].characters.begin() + 1);
    }
  };
  sketch.rounds(3, bus);
  CHECK(hasVoltage(sketch));
  CHECK(sketch.sbus.rejectedGroups() == 3);
  Raw<2> raw;  // slots 0 and 1 have come at different times: not before they come together
  CHECK(!sketch.sbus.readSensor(0, raw));
}

TEST_CASE("if the next frame is lost, its group is read up to that frame; if more are lost, it would be too old") {
  const struct {
    const char *what;
    uint8_t newest;
    unsigned lost;
    bool isRead;
  } rows[] = {
      {"one", 0x24, 1, true}, {"two", 0x34, 2, false}, {"none, with noise", 0x14, 1, false}, {"five", 0x24, 5, false}};
  for (const auto &row : rows) {
    CAPTURE(row.newest);
    sbus::Telemetry telemetry;
    telemetry.begin();
    for (const uint8_t data : {uint8_t{0x80}, uint8_t{0x99}}) {
      telemetry.taken(plainFrame(0, 0x04).data());
      telemetry.discarded((Bytes{0x83, data, 0x38}).data(), 3);
      if (data == 0x80) {
        telemetry.taken(plainFrame(0, 0x14).data());
      }
    }
    for (unsigned i = 0; i < row.lost; i++) {
      telemetry.discarded(plainFrame(1, 0x14).data(), 23);
    }
    telemetry.taken(plainFrame(2, row.newest).data());
    sbus::SlotData data;
    REQUIRE(telemetry.read(1, 1, &data));
    CHECK((data.data0 == 0x99) == row.isRead);
  }
}

TEST_CASE("without frames no sensor is read, and begin() forgets all of them") {
  Sketch sketch(1000);
  sketch.rounds(5);
  CHECK(hasVoltage(sketch));
  sketch.runTo(sketch.nextUs + 100000);
  CHECK(!hasVoltage(sketch));
  sketch.nextUs += 100000;
  sketch.rounds(1);
  CHECK(hasVoltage(sketch));
  sketch.sbus.begin();
  CHECK(sketch.sbus.rejectedGroups() == 0);
  sketch.nextUs += 20000;
  Bus silent;
  silent.change = [](unsigned, std::vector<Answer> &answers) { answers.clear(); };
  sketch.rounds(2, silent);
  CHECK(sketch.sbus.SBusFrameOk());
  CHECK(!hasSlots<1>(sketch.sbus, 1));
}

TEST_CASE(
    "a group in which bytes were lost or a frame with header 2F came is rejected even if it looks "
    "whole") {
  const Frame frame = plainFrame(0, 0x04);
  const Bytes whole = {0x83, 0x80, 0x38};
  const struct {
    const char *what;
    std::function<void(sbus::Telemetry &)> event;
    bool isRejected;
  } rows[] = {{"nothing", [](sbus::Telemetry &) {}, false},
              {"lost", [](sbus::Telemetry &telemetry) { telemetry.lost(); }, true},
              {"2F", [](sbus::Telemetry &telemetry) { telemetry.extra(); }, true}};
  for (const auto &row : rows) {
    CAPTURE(row.what);
    sbus::Telemetry telemetry;
    telemetry.begin();
    telemetry.taken(frame.data());
    telemetry.discarded(whole.data(), 2);
    row.event(telemetry);
    telemetry.discarded(whole.data() + 2, 1);
    telemetry.taken(frame.data());
    sbus::SlotData slot;
    CHECK(telemetry.read(1, 1, &slot) == !row.isRejected);
    CHECK(telemetry.rejectedGroups() == row.isRejected);
    telemetry.discarded(whole.data(), 3);
    telemetry.taken(frame.data());
    CHECK(telemetry.read(1, 1, &slot));
  }
}

TEST_CASE("if a port loses bytes between two frames, their group is rejected") {
  sbus::FrameFinderOf<sbus::Frame16, sbus::Telemetry> finder;
  uint32_t now = 0;
  const auto feed = [&](const Bytes &bytes, uint32_t silenceUs) {
    for (const uint8_t value : bytes) {
      now += 120;
      finder.poll(1, now);
      *finder.space() = value;
      finder.received(1, 0);
    }
    for (uint32_t us = 0; us < silenceUs; us += 100) {
      now += 100;
      finder.idle(now);
    }
  };
  for (const bool isBroken : {false, true}) {
    finder.reset(now, 120);
    for (unsigned number = 0; number < 4; number++) {
      feed(bytesOf(plainFrame(number, 0x04)), ToSlotsUs);
      feed({0x83, 0x80}, 0);
      if (isBroken && number == 2) {
        finder.broken();
      }
      feed({0x38}, 9000);
    }
    CHECK(finder.counters().frames == 4);
    CHECK(finder.events().rejectedGroups() == isBroken);
  }
}
