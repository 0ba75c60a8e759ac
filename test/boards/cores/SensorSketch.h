// A sketch with an SBus2Sensor on Serial1 of one core, CORE, and the S.BUS2 wire there: shared by all tests of sensors.
#pragma once

#include <SBus2Sensor.h>

#include "Cores.h"
#include "line/simulation/SimulatedBus.h"

namespace cores {

constexpr uint64_t Second = 1000000;
constexpr uint64_t Seconds = 100;
constexpr unsigned Rounds = static_cast<unsigned>(Seconds * Second / 60000);
constexpr uint64_t Listening = 5;  // rounds: in the first ones a sensor only listens
constexpr unsigned Slots = 5;      // that the board fills

// An S.BUS2 wire at Serial1. It measures how far off their times answers start; the judge does that for right answers
// only.
struct Bus : sim::Wire {
  static constexpr int Pin = sim::CorePin;
  line::SimulatedBus bus;
  const uint64_t startUs = world.nowUs;
  uint64_t lastUs = 0, frameEndUs = 0;
  unsigned row = 0;  // characters without a gap
  int64_t mostOffUs = 0;

  void until(uint64_t us) override {
    line::Character character;
    while (bus.next(us + world.earlyUs - startUs + line::CharacterUs, character)) {
      row = character.endUs == lastUs + line::CharacterUs ? row + 1 : 1;
      lastUs = character.endUs;
      frameEndUs = row == sbus::FrameSize ? lastUs : frameEndUs;
      character.endUs += startUs;
      world.line.push_back(character);
    }
  }

  void sent(const sim::Sent &sent) override {
    line::Character character;
    character.endUs = sent.beginUs - startUs + line::CharacterUs;
    character.value = sent.value;
    bus.hear(character);
    if (world.sent.size() % sbus::SlotSize == 1) {
      const int64_t after = static_cast<int64_t>(sent.beginUs - startUs - frameEndUs) - line::FirstSlotUs;
      const int64_t pitch = line::SlotPitchUs;
      const int64_t off = (after + pitch / 2 + pitch) % pitch - pitch / 2;
      mostOffUs = std::max(mostOffUs, off < 0 ? -off : off);
    }
  }

  virtual void check() const {}
  const line::BusJudge::Counts &counts() const { return bus.judge().counts(); }
};

// While loop() reads, nothing else may read; the ESP32's task takes a mutex for that.
struct Unheld : sim::Reader {
  void beforeRead() override {
#if defined(ESP32)
    world.crashes += world.locked == 0;
#else
    world.crashes += sbus::SlotTimer::isLocked();
#endif
  }
};

// `Option`, if any, is a parameter of the sensor's constructor besides the port.
template <typename Wire, typename... Option>
struct SketchOn {
  Wire wire;
  Unheld unheld;
  SBus2Sensor sensor{Serial1, Option()...};

  SketchOn() {
    cores::switchOn();
#if defined(ARDUINO_ARCH_RP2040)
    sim::alarms = sim::Alarms();
#endif
    world.tickUs = 1;
#if defined(ARDUINO_ARCH_RP2040)
    world.earlyUs = 15;  // its UART does not check the second stop bit (RP2040 datasheet, 4.2.2)
#endif
    world.wire = &wire;
    world.pin = Wire::Pin;
    world.reader = &unheld;
    wire.bus.share(line::LineSettings());
    sensor.begin();
    CHECK(sensor.writeSensor(6, sbus::VoltageSbs01V{56, 125}));
    CHECK(sensor.writeSensor(24, sbus::CurrentF1678{2345, 1234, 1500}));
  }
  ~SketchOn() { sensor.end(); }

  template <typename Loop>
  void run(Loop loop, uint64_t seconds = Seconds) {
    for (const uint64_t endUs = world.nowUs + seconds * Second; world.nowUs < endUs;) {
      loop();
    }
    MESSAGE(wire.bus.judge().text(), "; most off: ", wire.mostOffUs, " us; skipped ", sensor.skippedSlots());
    wire.check();
    CHECK(world.crashes == 0);
    CHECK(wire.mostOffUs <= +sbus::SlotSchedule::DeviationMax);
    CHECK(wire.counts().wrong() - wire.counts().late == 0);
    CHECK(sensor.sentSlots() - (wire.counts().right + wire.counts().late) <= 1);  // the last one may be under way
  }

  // Checks after run() that nearly every slot was answered in time, no frame was lost, and the other sensor, in slot
  // `other`, was read.
  void checkAll(uint8_t other) {
    CHECK(wire.counts().right >= (Rounds - Listening - 1) * Slots);
    CHECK(wire.counts().late == 0);
    CHECK(sensor.counters().frames >= 4 * Rounds - 2);
    CHECK(sensor.collisions() == 0);
    CHECK(sensor.rejectedGroups() == 0);
    sbus::TemperatureF1713 temperature;
    CHECK(sensor.readSensor(other, temperature));
  }
};

using Sketch = SketchOn<Bus>;

// Frames come every 15 ms, but for some time each fourth comes 1 to 9 ms early. Or loop() disables interrupts at
// random, for 10 us to longestUs; an ESP32's do that on the core that has its driver, which is late then. Answers are
// whole, at most 100 us off, and sent into no frame. The few frames that begin during an answer, or so shortly before
// that no port could have shown it, count apart: after them the sensor knows that frames may come early.
template <typename Sketch, typename Poll>
void disturb(Sketch &sketch, unsigned longestUs, unsigned apartUs, bool isUnsteady, unsigned long least, Poll poll) {
  std::minstd_rand random{20181};
  unsigned frame = 0;
  if (isUnsteady) {
    sketch.wire.bus.pace([&]() -> uint32_t {
      const bool isEarly = ++frame > 500 && frame < 1500 && random() % 4 == 0;
      return isEarly ? 14000 - static_cast<uint32_t>(random() % 8000) : 15000;
    });
  }
#if defined(ESP32)
  world.driverLateUs = longestUs;
  world.driverUs = longestUs / 10;
#endif
  for (uint8_t slot = 1; slot < sbus::SlotCount; slot++) {
    sketch.sensor.writeSensor(slot, sbus::TemperatureF1713{slot});
  }
  const uint64_t endUs = world.nowUs + Seconds * Second;
  for (uint64_t maskUs = world.nowUs; world.nowUs < endUs; poll()) {
    if (longestUs != 0 && world.nowUs >= maskUs) {
#if !defined(ESP32)
      Serial1.uart.turnOff(10 + random() % (1 + random() % longestUs));
#endif
      maskUs = world.nowUs + random() % apartUs;
    }
  }
  const line::BusJudge &judge = sketch.wire.bus.judge();
  MESSAGE(judge.text(), "; at most ", judge.mostOffUs(), " us off; skipped ", sketch.sensor.skippedSlots(), "; frames ",
          sketch.sensor.counters().frames);
  CHECK(world.crashes == 0);
  CHECK(judge.counts().wrong() - judge.counts().late - judge.counts().unseen == 0);
  CHECK(judge.counts().cut == 0);
  CHECK(judge.counts().met + judge.counts().unseen <= 10);
  CHECK(judge.mostOffUs() <= +sbus::SlotSchedule::DeviationMax);
  CHECK(judge.counts().right >= least);
}

const struct {
  unsigned longestUs, apartUs;
  bool isUnsteady;
  unsigned long least;  // right answers
} Disturbances[] = {
    {0, 1, true, 1000},       {60, 3000, false, 1000},  {500, 3000, false, 1000}, {500, 20000, false, 1000},
    {5000, 50000, false, 10}, {500, 20000, true, 1000}, {5000, 50000, true, 10},
};

}  // namespace cores
