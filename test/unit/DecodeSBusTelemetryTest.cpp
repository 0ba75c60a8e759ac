// DecodeSBusTelemetry on an S.BUS2 line: sensors are read in any loop, and their values grow old when they fall silent.
// Of damaged groups only whole slots are read.
#include "support/TelemetrySketch.h"

TEST_CASE(
    "in loops of 50 us to 4.9 ms, on every driver, all sensors are read, no group is rejected, no frame missed; also "
    "with "
    "a 00 after each transmission, as a Futaba R7008SB sends it, and with all slots in use") {
  const struct { bool hasBreaks, areAll; } lines[] = {{false, false}, {true, false}, {true, true}};
  for (const auto &line : lines) {
    for (const Driver &driver : {Board, ByteByByte, Esp32Told, Esp32}) {
      for (const uint32_t loopUs : {50u, 500u, 1000u, 3000u, 4000u, 4900u}) {
        INFO(driver.name, ", loopUs ", loopUs, ", hasBreaks ", line.hasBreaks, ", areAll ", line.areAll);
        Sketch sketch(loopUs, driver);
        Bus bus;
        bus.hasBreaks = line.hasBreaks;
        if (line.areAll) {
          bus.change = [](unsigned, std::vector<Answer> &answers) {
            for (uint8_t slot = 3; slot < 8 && answers.size() >= 3 && answers[0].slot == 0; slot++) {
              answers.push_back({slot, {sbus::slotId(slot), 0x00, slot}});
            }
          };
        }
        CHECK(!hasVoltage(sketch));
        sketch.rounds(10, bus);
        CHECK(hasVoltage(sketch));
        CHECK(hasCurrent(sketch));
        sbus::ReceiverVoltage receiver;
        REQUIRE(sketch.sbus.readSensor(0, receiver));
        CHECK(receiver.decivolts == 46);
        CHECK(receiver.isExternal);  // the tenth round's
        CHECK(sketch.sbus.rejectedGroups() == 0);
        CHECK(sketch.sbus.counters().frames >= (line.hasBreaks ? 38 : 39));
        CHECK(sketch.sbus.counters().resyncs == 0);
        CHECK(hasSlots<8>(sketch.sbus, 0) == line.areAll);
        CHECK(hasSlots<1>(sketch.sbus, 3) == line.areAll);
        CHECK(hasSlots<2>(sketch.sbus, 2) == line.areAll);  // otherwise slot 3 is empty
        for (const uint8_t empty : std::initializer_list<uint8_t>{8, 16, 23, 27, 31}) {
          CHECK(!hasSlots<1>(sketch.sbus, empty));
        }
        CHECK(!hasSlots<2>(sketch.sbus, 31));
        CHECK(!hasSlots<1>(sketch.sbus, 200));
      }
    }
  }
}

TEST_CASE("a sensor that falls silent is read for 16 more rounds, a second, and again when it comes back") {
  Sketch sketch(1000);
  Bus bus;
  sketch.rounds(5, bus);
  CHECK(hasVoltage(sketch));
  bus.changeFirst([](std::vector<Answer> &answers) {
    answers.pop_back();  // slot 2 of the SBS-01V
  });
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
        finder.bytesLost();
      }
      feed({0x38}, 9000);
    }
    CHECK(finder.counters().frames == 4);
    CHECK(finder.events().rejectedGroups() == isBroken);
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
    bus.changeFirst([lost](std::vector<Answer> &answers) {
      answers[1].characters[1] = 0x81;
      answers[2].characters[1] = 0x99;  // a value that must not be read
      answers[2].characters.erase(answers[2].characters.begin() + static_cast<std::ptrdiff_t>(lost));
    });
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
  sbus::Trust trust = {};
  REQUIRE(sketch.sbus.readSensor(24, current, trust));
  CHECK(trust.age == 60 + 11);
  CHECK(trust.times == 8);
  bool isSlot1 = true;
  bus.changeFirst([&isSlot1](std::vector<Answer> &answers) {
    answers[2].characters[1] = 0x99;
    if (!isSlot1) {
      answers.erase(answers.begin() + 1);
    }
  });
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

TEST_CASE("a slot that lost its ID, and looks like a slot that is not on the line, is read as neither") {
  Sketch sketch(1000);
  Bus bus;
  bus.hasBreaks = true;
  sketch.rounds(5, bus);
  bus.changeFirst([](std::vector<Answer> &answers) {
    answers[1].characters[1] = 0x99;
    answers[2].characters = {0xC3, 0x38};  // 43 is missing: with the break it looks like slot 3
  });
  sketch.rounds(3, bus);
  CHECK(!hasSlots<1>(sketch.sbus, 3));
  CHECK(data0Of(sketch.sbus, 1) == 0x80);  // what follows without its ID may belong to it
  CHECK(data0Of(sketch.sbus, 2) == 0x00);
  CHECK(sketch.sbus.rejectedGroups() == 3);
}

TEST_CASE("after a line was cut, a value from before it is not read, or its age has the time of the cut") {
  Bus empty;
  empty.change = [](unsigned, std::vector<Answer> &answers) { answers.clear(); };
  for (const unsigned ms : {60u, 120u, 180u, 600u, 900u, 960u, 1020u, 5000u, 60000u, 2147483u, 2147484u, 3600000u}) {
    CAPTURE(ms);
    Sketch sketch(1000);
    sketch.rounds(5);
    const uint64_t came = sketch.nextUs - 4 * PeriodUs;
    sketch.nextUs += ms * uint64_t{1000};
    sketch.rounds(1, empty);
    Raw<1> raw;
    sbus::Trust trust = {};
    const bool isRead = sketch.sbus.readSensor(1, raw, trust);
    CHECK(isRead == (ms <= 900));
    if (isRead) {
      const uint64_t age = (fakeMicros - came) / 1000;  // ms, of the beginning of the frame that announced it
      CHECK(trust.age + 4 >= age);
      CHECK(trust.age <= age);
    }
  }
}

TEST_CASE("while frames are missing, the age goes on") {
  for (const uint8_t slot : {uint8_t{1}, uint8_t{8}, uint8_t{31}}) {
    for (unsigned lost = 0; lost < 4; lost++) {
      CAPTURE(lost);
      sbus::Telemetry telemetry;
      telemetry.begin();
      const auto take = [&](unsigned frame, uint32_t us) {
        telemetry.interval(us);
        telemetry.accepted(plainFrame(0, static_cast<uint8_t>(frame % 4 << 4 | 4)).data());
      };
      unsigned frame = slot / sbus::SlotsOfGroup;
      take(frame, PeriodUs);
      telemetry.discarded((Bytes{sbus::slotId(slot), 0x80, 0x38}).data(), 3);
      take(++frame, PeriodUs);
      take(frame + 1 + lost, (1 + lost) * PeriodUs);
      sbus::SlotData data;
      sbus::Trust trust = {};
      REQUIRE(telemetry.read(slot, 1, &data, trust));
      CHECK(trust.age == 15 * (2 + lost));
    }
  }
}

TEST_CASE("an age above 65535 ms is told as 65535") {
  Sketch sketch(1000);
  sketch.sbus.setTimeout(0);
  sketch.rounds(5);
  for (const unsigned s : {65u, 66u, 131u, 3600u}) {
    CAPTURE(s);
    sketch.runTo(sketch.nextUs + s * uint64_t{1000000});
    Raw<1> raw;
    sbus::Trust trust = {};
    REQUIRE(sketch.sbus.readSensor(1, raw, trust));
    CHECK(trust.age == (s == 65 ? 65057 : 65535));
  }
}

TEST_CASE("the slots of a sensor change together: while one of them is damaged, all keep their values") {
  Sketch sketch(1000);
  Bus bus;
  sketch.rounds(5, bus);
  CHECK(hasVoltage(sketch));
  bus.changeFirst([](std::vector<Answer> &answers) {
    answers[1].characters[1] = 0x99;
    answers[2].characters.erase(answers[2].characters.begin() + 1);
  });
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
      telemetry.accepted(plainFrame(0, 0x04).data());
      telemetry.discarded((Bytes{0x83, data, 0x38}).data(), 3);
      if (data == 0x80) {
        telemetry.accepted(plainFrame(0, 0x14).data());
      }
    }
    for (unsigned i = 0; i < row.lost; i++) {
      telemetry.discarded(plainFrame(1, 0x14).data(), 23);
    }
    telemetry.accepted(plainFrame(2, row.newest).data());
    sbus::SlotData data;
    REQUIRE(telemetry.read(1, 1, &data));
    CHECK((data.data0 == 0x99) == row.isRead);
  }
}
