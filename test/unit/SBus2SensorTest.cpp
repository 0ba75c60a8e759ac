// SBus2Sensor on a simulated S.BUS2 wire: its answers are in their slots as long as loop() is quick, and are skipped
// otherwise; frames and other sensors are read meanwhile.
#include <doctest/doctest.h>

#include <cstdint>

#include "line/simulation/SimulatedBus.h"
#include "support/FakeClock.h"
#include "support/UartPort.h"

// After Arduino.h.
#include <SBus2Sensor.h>

namespace {

// The board's port, with TX at the wire through a diode.
class BusPort : public BoardsPort {
 public:
  explicit BusPort(line::SimulatedBus &bus) : _bus(bus) { _bus.share(line::LineSettings()); }

  using UartPort::begin;
  size_t write(uint8_t value) override {
    line::Character character;
    _freeUs = std::max(_freeUs, fakeMicros) + line::CharacterUs;
    character.endUs = _freeUs;
    character.value = value;
    _bus.hear(character);
    return 1;
  }
  using Print::write;

 private:
  line::SimulatedBus &_bus;
  uint64_t _freeUs = 0;
};

struct Sketch {
  line::SimulatedBus bus;
  BusPort port{bus};
  SBus2Sensor sensor{port};
  uint64_t loops = 0;

  explicit Sketch(line::BusMode mode = line::BusMode::Slots) : bus(line::Flight, mode) {
    fakeMicros = 0;
    sensor.begin();
  }

  // loop() takes loopUs(number of its call).
  template <typename LoopUs>
  void run(uint64_t untilUs, LoopUs loopUs) {
    while (fakeMicros < untilUs) {
      fakeMicros += loopUs(loops++);
      line::Character character;
      while (bus.next(fakeMicros + line::CharacterUs, character)) {
        port.receive(character);
      }
      port.advance(fakeMicros);
      sensor.parseSBusFrame();
    }
  }
  void run(uint64_t untilUs, uint32_t loopUs) {
    run(untilUs, [=](uint64_t) { return loopUs; });
  }

  const line::BusJudge::Counts &counts() const { return bus.judge().counts(); }
};

constexpr uint64_t Second = 1000000;
// Rounds of 60 ms, within the seconds that the tests take. In the first ones the sensor only listens.
constexpr uint64_t Flight = 25 * Second, Rounds = Flight / 60000, Listening = 5;

constexpr sbus::VoltageSbs01V Voltage = {56, 125};
constexpr sbus::CurrentF1678 Current = {2345, 1234, 1500};

}  // namespace

TEST_CASE(
    "with a loop() of up to 75 us nearly every slot is answered, within 50 us of its time, and no frame is lost") {
  for (const uint32_t loopUs : {10u, 37u, 50u, 75u}) {
    CAPTURE(loopUs);
    Sketch sketch;
    sketch.bus.add({3, {1, 2}});
    CHECK(sketch.sensor.writeSensor(6, Voltage));
    CHECK(sketch.sensor.writeSensor(24, Current));
    sketch.run(Flight, loopUs);
    MESSAGE(loopUs, " us: ", sketch.bus.judge().text());
    CHECK(sketch.counts().right >= (Rounds - Listening - 1) * 5);
    CHECK(sketch.counts().right == sketch.sensor.sentSlots());
    CHECK(sketch.counts().wrong() == 0);
    CHECK(sketch.sensor.collisions() == 0);
    CHECK(sketch.sensor.counters().frames >= 4 * Rounds - 1);
    sbus::ReceiverVoltage voltage;
    CHECK(sketch.sensor.readSensor(0, voltage));
    sbus::TemperatureF1713 other;
    sbus::Trust trust;
    CHECK(sketch.sensor.readSensor(3, other, trust));
    CHECK(trust.times == 8);
    sbus::VoltageSbs01V own;
    CHECK(!sketch.sensor.readSensor(6, own));
    CHECK(sketch.sensor.rejectedGroups() == 0);
  }
}

TEST_CASE("with a slower loop() slots are skipped and counted; no answer is more than 100 us off") {
  for (const uint32_t loopUs : {76u, 100u, 150u, 500u, 1000u, 3000u, 7000u}) {
    CAPTURE(loopUs);
    Sketch sketch;
    CHECK(sketch.sensor.writeSensor(1, Voltage));
    CHECK(sketch.sensor.writeSensor(16, Current));
    sketch.run(Flight, loopUs);
    MESSAGE(loopUs, " us: ", sketch.bus.judge().text(), "; skipped ", sketch.sensor.skippedSlots());
    CHECK(sketch.counts().wrong() == 0);
    CHECK(sketch.sensor.sentSlots() == sketch.counts().right);
    CHECK(sketch.sensor.sentSlots() + sketch.sensor.skippedSlots() >= (Rounds - 3) * 5);
    CHECK(sketch.sensor.skippedSlots() > 0);
  }
}

TEST_CASE("writeSensor() returns false for 200 A, which it answers, and where no sensor can stand, which it does not") {
  Sketch sketch;
  CHECK(!sketch.sensor.writeSensor(24, sbus::CurrentF1678{20000, 1234, 1500}));
  CHECK(!sketch.sensor.writeSensor(0, Voltage));
  CHECK(!sketch.sensor.writeSensor(7, Voltage));
  sketch.run(Second, 50u);
  CHECK(sketch.counts().right == sketch.sensor.sentSlots());
  CHECK(sketch.sensor.sentSlots() % 3 == 0);
  CHECK(sketch.sensor.sentSlots() > 0);
  CHECK(sketch.counts().wrong() == 0);
}

TEST_CASE("a receiver that announces no slots gets no answer") {
  for (const auto mode : {line::BusMode::NoTelemetry, line::BusMode::OnlySlot0}) {
    Sketch sketch(mode);
    CHECK(sketch.sensor.writeSensor(1, Voltage));
    sketch.run(10 * Second, 50u);
    CHECK(sketch.sensor.counters().frames > 600);
    CHECK(sketch.counts().right + sketch.counts().wrong() == 0);
    CHECK(sketch.sensor.skippedSlots() == 0);
  }
}

TEST_CASE("two sensors in one slot: ours notices it, and answers less and less") {
  Sketch sketch;
  sketch.bus.add({1, {1, 2}});
  CHECK(sketch.sensor.writeSensor(1, Voltage));
  sketch.run(30 * Second, 50u);
  CHECK(sketch.counts().collided >= 4);
  CHECK(sketch.counts().collided <= 10);
  CHECK(sketch.sensor.collisions() == sketch.counts().collided);
  CHECK(sketch.sensor.skippedSlots() > 900);
}

TEST_CASE("on a port that does not say when a frame ended, nothing is answered") {
  line::SimulatedBus bus;
  UartPort port;
  SBus2Sensor sensor(port);
  fakeMicros = 0;
  sensor.begin();
  CHECK(sensor.writeSensor(1, Voltage));
  while (fakeMicros < Second) {
    fakeMicros += 20;
    line::Character character;
    while (bus.next(fakeMicros + line::CharacterUs, character)) {
      port.receive(character);
    }
    port.advance(fakeMicros);
    sensor.parseSBusFrame();
  }
  CHECK(sensor.counters().frames > 60);
  CHECK(sensor.sentSlots() == 0);
  CHECK(sensor.skippedSlots() >= 30);
}

TEST_CASE("a frame's end lies between two polls, less the time that the port needs to hand it over") {
  using sbus::ReceiveNotice;
  constexpr uint32_t Before = 10000, By = 10050;
  const struct {
    ReceiveNotice notice;
    unsigned found;
    uint32_t earliest, latest;
  } rows[] = {
      {ReceiveNotice::EachCharacter, 1, 9990, 10065}, {ReceiveNotice::EachCharacter, 16, 9990, 10065},
      {ReceiveNotice::Dma16, 16, 9990, 10065},        {ReceiveNotice::Dma16, 9, 9870, 9945},
      {ReceiveNotice::Dma16, 25, 9870, 9945},
  };
  for (const auto &row : rows) {
    CAPTURE(row.found);
    const sbus::FrameEnd end = sbus::frameEndOf(row.notice, row.found, Before, By);
    CHECK(end.earliest == row.earliest);
    CHECK(end.latest == row.latest);
  }
  const sbus::FrameEnd unknown = sbus::frameEndOf(ReceiveNotice::Unknown, 1, Before, By);
  CHECK(unknown.latest - unknown.earliest > sbus::SlotSchedule::DeviationMax);
}

TEST_CASE("if two callbacks disagree on a frame's end, one was held up: nothing is known") {
  using sbus::ReceiveNotice;
  constexpr uint32_t Before = 10000;  // 9 characters follow, and the callback comes when the line was idle for one
  constexpr uint32_t Prompt = Before + 10 * 120;
  const struct {
    int32_t heldUp;
    bool isKnown;
    uint32_t latest;
  } rows[] = {{0, true, 11080},   {40, true, 11080}, {41, false, 0},
              {-40, true, 11040}, {-41, false, 0},   {3000, false, 0}};
  for (const auto &row : rows) {
    CAPTURE(row.heldUp);
    const sbus::FrameEnd end =
        sbus::frameEndOfCallback(ReceiveNotice::Dma16, 9, Before, Prompt + static_cast<uint32_t>(row.heldUp));
    CHECK((end.latest - end.earliest <= sbus::SlotSchedule::DeviationMax) == row.isKnown);
    if (row.isKnown) {
      CHECK(end.latest == row.latest);
      CHECK(end.latest - end.earliest == 40);
    }
  }
}
