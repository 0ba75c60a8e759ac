// SBus2Sensor on the ports of one core, CORE, with a sketch that calls parseSBusFrame() all the time: with a diode, and
// on a single wire, which the board may drive in its own slots only.
#include <algorithm>
#include <deque>

#include "SensorSketch.h"

decltype(Serial1) Serial1, Serial2;

using namespace cores;

namespace {

// TX itself is the wire: while the board drives it, LOW or HIGH, it destroys what others send.
struct SingleWire : Bus {
  static constexpr int Pin = sim::CoreTxPin;
  std::deque<uint64_t> ownEnds;  // of characters that are not yet in world.line
  unsigned destroyed = 0, pulledUp = 0;
  uint64_t mayHoldUs = 1;

  void until(uint64_t us) override {
    size_t i = world.line.size();
    Bus::until(us);
    for (; i < world.line.size(); i++) {
      const uint64_t endUs = world.line[i].endUs;
      if (!ownEnds.empty() && ownEnds.front() == endUs) {
        ownEnds.pop_front();
      } else {
        destroyed += world.drivenWithin(endUs - line::CharacterUs, endUs) != nullptr;
      }
    }
    pulledUp += Serial1.uart.isOpen() && Serial1.uart.isHalfDuplex() && !Serial1.uart.settings().txInverted;
  }

  void sent(const sim::Sent &sent) override {
    Bus::sent(sent);
    ownEnds.push_back(sent.beginUs + line::CharacterUs);
  }

  // The longest time for which the board has driven the wire before or after a slot, or without a slot.
  static uint64_t heldUs() {
    uint64_t most = 0;
    size_t i = 0;
    for (const sim::Driven &driven : world.driven) {
      uint64_t restUs = driven.fromUs;
      const uint64_t untilUs = std::min(driven.untilUs, world.nowUs);
      for (; i < world.sent.size() && world.sent[i].beginUs < untilUs; i++) {
        if (world.sent[i].beginUs >= driven.fromUs) {
          most = std::max(most, world.sent[i].beginUs - restUs);
          restUs = std::min(world.sent[i].endUs, untilUs);
        }
      }
      most = std::max(most, untilUs - restUs);
    }
    return most;
  }

  void check() const override {
    CHECK(destroyed == 0);
    CHECK(pulledUp == 0);
    CHECK(heldUs() <= mayHoldUs);
  }
};

using WithDiode = Sketch;
using OnSingleWire = SketchOn<SingleWire, sbus::SingleWireTag>;

template <typename Sketch>
void run(Sketch &sketch, unsigned loopUs, uint64_t seconds = Seconds) {
  sketch.run(
      [&] {
        delayMicroseconds(loopUs);
        sketch.sensor.parseSBusFrame();
      },
      seconds);
}

}  // namespace

TEST_CASE_TEMPLATE(
    "with a loop() of up to 60 us nearly every slot is answered, within 50 us of its time, and no frame is lost",
    Sketch, WithDiode, OnSingleWire) {
  for (const unsigned earlyUs : {0u, 15u}) {
    for (const unsigned loopUs : {10u, 60u}) {
      CAPTURE(earlyUs);
      CAPTURE(loopUs);
      Sketch sketch;
      world.earlyUs = earlyUs;
      sketch.wire.bus.add({3, {1, 2}});
      run(sketch, loopUs);
      sketch.checkAll(3);
      sbus::VoltageSbs01V own;
      CHECK(!sketch.sensor.readSensor(6, own));
    }
  }
}

TEST_CASE_TEMPLATE("with a slower loop() slots are skipped and counted; no answer is more than 100 us off", Sketch,
                   WithDiode, OnSingleWire) {
  for (const unsigned loopUs : {76u, 100u, 500u, 3000u}) {
    CAPTURE(loopUs);
    Sketch sketch;
    run(sketch, loopUs);
    CHECK(sketch.sensor.sentSlots() + sketch.sensor.skippedSlots() >= (Rounds - Listening - 1) * Slots);
    CHECK(sketch.sensor.skippedSlots() > 0);
  }
}

TEST_CASE("interrupts disabled at random, and frames that come early: answers are whole, in time, and meet no frame") {
  for (const auto &each : Disturbances) {
    CAPTURE(each.longestUs);
    CAPTURE(each.apartUs);
    CAPTURE(each.isUnsteady);
    WithDiode sketch;
    disturb(sketch, each.longestUs, each.apartUs, each.isUnsteady, each.least, [&] {
      delayMicroseconds(20);
      sketch.sensor.parseSBusFrame();
    });
  }
}

TEST_CASE_TEMPLATE("after end() nothing is sent; after begin() answers continue", Sketch, WithDiode, OnSingleWire) {
  Sketch sketch;
  run(sketch, 37, 10);
  const unsigned long right = sketch.wire.counts().right;
  CHECK(right >= 9 * Second / 60000 * Slots);
  const size_t sent = world.sent.size();
  sketch.sensor.end();
  CHECK(!Serial1.uart.isOpen());
  delay(10000);
  CHECK(world.sent.size() == sent);
  sketch.sensor.begin();
  for (const uint64_t endUs = world.nowUs + 10 * Second; world.nowUs < endUs; delayMicroseconds(37)) {
    sketch.sensor.parseSBusFrame();
  }
  CHECK(sketch.wire.counts().right >= right + 9 * Second / 60000 * Slots);
  sketch.wire.check();
}

TEST_CASE(
    "on a single wire, the wire is free after begin(), listen() or end() at any time, after a begin() that fails, and "
    "after another format") {
  using Step = void (*)(SBus2Sensor &);
  const Step steps[] = {
      [](SBus2Sensor &sensor) { sensor.begin(); },
      [](SBus2Sensor &sensor) { sensor.end(); },
      [](SBus2Sensor &sensor) { sensor.listen(); },
      [](SBus2Sensor &sensor) { sensor.begin(0); },
      [](SBus2Sensor &sensor) { sensor.begin(200000); },
      [](SBus2Sensor &sensor) { sensor.begin(100000, SERIAL_8N1); },
      [](SBus2Sensor &sensor) { sensor.begin(100000, SERIAL_8E2); },
      [](SBus2Sensor &sensor) { sensor.begin(100000, SERIAL_8E2 | SERIAL_HALF_DUPLEX); },
  };
  std::minstd_rand random{20181};
  unsigned sending = 0;
  for (const Step &first : steps) {
    for (const Step &second : steps) {
      OnSingleWire sketch;
      const size_t order = static_cast<size_t>(&first - steps) * 10 + static_cast<size_t>(&second - steps);
      CAPTURE(order);
      const auto pollUntil = [&](uint64_t us, size_t sent) {
        while (world.nowUs < us && world.sent.size() <= sent) {
          delayMicroseconds(20);
          if (Serial1.uart.isOpen()) {
            sketch.sensor.parseSBusFrame();
          }
        }
      };
      for (unsigned round = 0; round < 10; round++) {
        for (const Step &step : {first, second}) {
          pollUntil(world.nowUs + 300000 + random() % 100000, round % 2 == 0 ? SIZE_MAX : world.sent.size());
          sending += Serial1.uart.pending() != 0;
          step(sketch.sensor);
        }
      }
      sketch.sensor.begin();
      pollUntil(world.nowUs + Second, SIZE_MAX);
      CHECK(sketch.sensor.sentSlots() >= (15 - Listening) * Slots);
      CHECK(sketch.sensor.counters().frames >= 60);
      CHECK(sketch.wire.counts().wrong() == 0);
      CHECK(world.crashes == 0);
      sketch.wire.check();
    }
  }
  CHECK(sending >= 300);
}

TEST_CASE("on a single wire, interrupts that are off for up to 100 us hold the wire no longer, and no frame is lost") {
  OnSingleWire sketch;
  sketch.wire.mayHoldUs = 100;
  sketch.run([&] {
    delayMicroseconds(20);
    world.masked++;
    delayMicroseconds(40 + world.upTo(60));
    world.masked--;
    sketch.sensor.parseSBusFrame();
  });
  CHECK(SingleWire::heldUs() >= 50);
  CHECK(sketch.sensor.counters().frames >= 4 * Rounds - 2);
}

TEST_CASE("on a single wire, a port that hears itself, as other chips do, makes no difference") {
  OnSingleWire sketch;
  world.echoes = true;
  run(sketch, 37);
  CHECK(sketch.wire.counts().right >= (Rounds - Listening - 1) * Slots);
  CHECK(sketch.sensor.collisions() == 0);
  CHECK(sketch.sensor.rejectedGroups() == 0);
}

TEST_CASE(
    "two sensors in one slot: with a diode the board notices, on a single wire only what comes after its own answer") {
  const struct {
    int32_t offUs;
    bool withDiode, onSingleWire;  // it notices, and then answers less and less
  } rows[] = {{0, true, false}, {-40, true, false}, {60, true, true}};
  for (const auto &row : rows) {
    CAPTURE(row.offUs);
    const auto notices = [&](auto &sketch) {
      sketch.wire.bus.add({6, {1, 2}, row.offUs});
      for (const uint64_t endUs = world.nowUs + 10 * Second; world.nowUs < endUs; delayMicroseconds(20)) {
        sketch.sensor.parseSBusFrame();
      }
      CHECK(sketch.sensor.counters().frames >= 660);
      const bool isNoticed = sketch.sensor.collisions() != 0;
      CHECK(sketch.wire.counts().collided >= (isNoticed ? 4u : 155u));  // of 161
      CHECK(sketch.sensor.collisions() <= 10);
      return isNoticed;
    };
    WithDiode withDiode;
    CHECK(notices(withDiode) == row.withDiode);
    OnSingleWire onSingleWire;
    CHECK(notices(onSingleWire) == row.onSingleWire);
  }
}
