// A sketch with an SBus2Sensor on Serial1 of one core, CORE, and the S.BUS2 wire there: shared by all tests of sensors.
#pragma once

#include <SBus2Sensor.h>

#include "Cores.h"
#if defined(ARDUINO_ARCH_RP2040)
#include "PicoAlarms.h"
#endif
#include "line/simulation/SimulatedBus.h"

namespace cores {

constexpr uint64_t Second = 1000000;
constexpr uint64_t Seconds = 100;
constexpr unsigned Rounds = static_cast<unsigned>(Seconds * Second / 60000);
constexpr uint64_t Listening = 5;  // rounds: in the first ones a sensor only listens
constexpr unsigned Slots = 5;  // that the board fills

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
    world.crashes += sbus::SlotTimer::isHeld();
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
    CHECK(wire.mostOffUs <= +sbus::Answers::MostOff);
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

}  // namespace cores
