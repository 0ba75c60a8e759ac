// DecodeSBusTelemetry on an S.BUS2 line: sensors are read in any loop, and their values grow old when they fall silent.
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
