// SBus2Sensor on the ports of one core, CORE, where a timer answers the slots: in time while loop() does other things,
// and never late.
#include <functional>

#include "SensorSketch.h"

decltype(Serial1) Serial1, Serial2;

using namespace cores;

TEST_CASE("while loop() is in delay(3), nearly every slot is answered within 50 us of its time, and no frame is lost") {
  Sketch sketch;
  sketch.wire.bus.add({3, {1, 2}});
  sketch.run([&] {
    delay(3);
    sketch.sensor.parseSBusFrame();
  });
  sketch.checkAll(3);
}

TEST_CASE("while loop() reads channels and writes sensors all the time, frames and answers continue") {
  Sketch sketch;
  sketch.run([&] {
    uint16_t channels[18];
    bool failsafe, lostFrame;
    sketch.sensor.decodeSBusFrame(channels, failsafe, lostFrame);
    sketch.sensor.writeSensor(6, sbus::VoltageSbs01V{56, 125});
    delayMicroseconds(3);
  });
  CHECK(sketch.wire.counts().right >= Rounds * Slots * 9 / 10);
  CHECK(sketch.wire.counts().late == 0);
  CHECK(sketch.sensor.counters().frames >= 4 * Rounds - 2);
}

TEST_CASE("with other interrupts of up to 1 ms, late answers are skipped") {
  for (const unsigned othersUs : {20u, 60u, 150u, 400u, 900u}) {
    CAPTURE(othersUs);
    Sketch sketch;
    world.othersUs = othersUs;
    world.portUs = 1;
    world.cacheUs = 40;
    sketch.run([&] { delay(3); });
    CHECK((othersUs > 60 || sketch.wire.counts().right >= Rounds * Slots * 2 / 3));
    CHECK((othersUs < 150 || sketch.sensor.skippedSlots() > 0));
  }
}

TEST_CASE("while loop() disables interrupts, late answers are skipped") {
  for (const unsigned maskedUs : {30u, 90u, 200u, 3000u}) {
    CAPTURE(maskedUs);
    Sketch sketch;
    sketch.run([&] {
      delayMicroseconds(777);
      world.masked++;
      delayMicroseconds(maskedUs);
      world.masked--;
    });
    CHECK((maskedUs > 90 || sketch.wire.counts().right >= Rounds * Slots / 3));
    CHECK((maskedUs < 200 || sketch.sensor.skippedSlots() > 0));
  }
}

TEST_CASE("if loop() reads the port itself, no answer is wrong, and nearly all are sent") {
  for (const unsigned portUs : {1u, 2u, 5u}) {
    CAPTURE(portUs);
    Sketch sketch;
    world.portUs = portUs;
    sketch.run([&] {
      Serial1.peek();
      delayMicroseconds(7);
    });
    CHECK(sketch.wire.counts().right >= Rounds * Slots * 9 / 10);
  }
}

TEST_CASE("interrupts disabled at random, and frames that come early: answers are whole, in time, and meet no frame") {
  for (const auto &each : Disturbances) {
    CAPTURE(each.longestUs);
    CAPTURE(each.apartUs);
    CAPTURE(each.isUnsteady);
    Sketch sketch;
    disturb(sketch, each.longestUs, each.apartUs, each.isUnsteady, each.least, [] { delayMicroseconds(50); });
  }
}

TEST_CASE("after end() nothing is sent; after begin() answers continue") {
  Sketch sketch;
  sketch.run([] { delay(1); }, 10);
  const unsigned long right = sketch.wire.counts().right;
  const size_t sent = world.sent.size();
  CHECK(right >= 9 * Second / 60000 * Slots);
  CHECK(sent >= 9 * Second / 60000 * Slots * 3);
  sketch.sensor.end();
  sketch.run([] { delay(1); }, 10);
  CHECK(sketch.wire.counts().right == right);
  CHECK(world.sent.size() == sent);
  CHECK(world.alarmAtUs == +sim::World::Never);
  sketch.sensor.begin();
  for (const uint64_t endUs = world.nowUs + 10 * Second; world.nowUs < endUs;) {
    delay(1);
  }
  CHECK(sketch.wire.counts().right >= right + 9 * Second / 60000 * Slots);
}

#if defined(ARDUINO_ARCH_RP2040)

TEST_CASE("after end() the alarm is free") {
  Sketch sketch;
  CHECK(sim::alarms.claimed == (8 | 1));
  sketch.run([] { delay(1); }, 10);
  sketch.sensor.end();
  CHECK(sim::alarms.claimed == 8);
  CHECK(sim::alarms.priority[0] == 0x80);
}

TEST_CASE("without a free alarm parseSBusFrame() answers") {
  Sketch sketch;
  sketch.sensor.end();
  sim::alarms.claimed = 15;
  sketch.sensor.begin();
  sketch.run([&] {
    delayMicroseconds(40);
    sketch.sensor.parseSBusFrame();
  });
  CHECK(sketch.wire.counts().right >= (Rounds - Listening - 1) * Slots);
  CHECK(sketch.wire.counts().late == 0);
  CHECK(sim::alarms.claimed == 15);
}

TEST_CASE("a second sensor is polled, and its end() leaves the first one its alarm") {
  Sketch sketch;
  SBus2Sensor second(Serial2);
  second.begin();
  second.end();
  sketch.run([] { delay(3); }, 10);
  CHECK(sketch.wire.counts().right >= 9 * Second / 60000 * Slots);
}

#else

TEST_CASE("with a driver whose interrupt comes late at random, none of 10000 answers is late") {
  constexpr uint64_t Long = 130;
  for (const unsigned lateUs : {20u, 200u, 1000u, 2000u, 5000u}) {
    CAPTURE(lateUs);
    Sketch sketch;
    world.driverLateUs = lateUs;
    world.driverUs = 90;
    world.earlyUs = 15;
    world.portUs = 3;
    sketch.run([] { delay(3); }, Long);
    CHECK(sketch.wire.counts().late + sketch.wire.counts().early == 0);
    // From 1 ms on the driver loses characters, and so frames: then the sensor only listens for some time.
    const uint64_t least = lateUs > 1000 ? 50 : lateUs == 1000 ? 2000 : 10000;
    CHECK(sketch.wire.counts().right >= least);
  }
}

TEST_CASE("with tasks and writes to flash that stop all else for up to 5 ms at random, late answers are skipped") {
  for (const unsigned randomUs : {50u, 300u, 1000u, 5000u}) {
    CAPTURE(randomUs);
    Sketch sketch;
    world.driverLateUs = 300;
    world.driverUs = 90;
    world.earlyUs = 15;
    world.portUs = 3;
    world.cacheUs = 40;
    world.randomUs = randomUs;
    sketch.run([] { delay(3); }, 130);
    CHECK(sketch.sensor.skippedSlots() > 0);
    CHECK(sketch.wire.counts().right >= Rounds * Slots / 2);
  }
}

TEST_CASE("if code in flash waits long for the cache, a late answer is not sent, and counts as skipped") {
  Sketch sketch;
  world.cacheUs = 1000;
  sketch.run([] { delay(3); });
  CHECK(sketch.sensor.skippedSlots() > 0);
  CHECK(sketch.sensor.collisions() == 0);  // the board hears itself
}

TEST_CASE("each method that loop() calls waits for the task, which may be in the middle of a frame") {
  Sketch sketch;
  sketch.run([] { delay(3); }, 1);
  uint16_t channels[18];
  bool failsafe, lostFrame;
  sbus::TemperatureF1713 other;
  const SBus2Sensor &constant = sketch.sensor;
  const auto locks = [](std::function<void()> method) {
    const unsigned before = world.locks;
    method();
    return world.locks - before;
  };
  CHECK(locks([&] { sketch.sensor.SBusFrameOk(); }) == 1);
  CHECK(locks([&] { sketch.sensor.decodeSBusFrame(channels, failsafe, lostFrame); }) == 1);
  CHECK(locks([&] { sketch.sensor.newFrame(); }) == 1);
  CHECK(locks([&] { sketch.sensor.linkState(); }) == 1);
  CHECK(locks([&] { sketch.sensor.frameAge(); }) == 1);
  CHECK(locks([&] { constant.counters(); }) == 1);
  CHECK(locks([&] { sketch.sensor.setLossLimit(50); }) == 1);
  CHECK(locks([&] { sketch.sensor.readSensor(3, other); }) == 1);
  CHECK(locks([&] { constant.rejectedGroups(); }) == 1);
  CHECK(locks([&] { sketch.sensor.writeSensor(3, other); }) == 1);
  CHECK(locks([&] { sketch.sensor.stopSensor(3, 1); }) == 1);
  CHECK(locks([&] { sketch.sensor.end(); }) == 1);
}

TEST_CASE("while the port sends something else, answers are skipped, and do not queue behind it") {
  Sketch sketch;
  sketch.run([] { delay(3); }, 1);
  struct : sim::Wire {
    Bus *bus;
    void until(uint64_t us) override { bus->until(us); }
    void sent(const sim::Sent &) override {}
  } deaf;
  deaf.bus = &sketch.wire;
  world.wire = &deaf;
  const uint32_t skipped = sketch.sensor.skippedSlots();
  const size_t sent = world.sent.size();
  unsigned others = 0;
  for (const uint64_t endUs = world.nowUs + 60000; world.nowUs < endUs; delayMicroseconds(100)) {
    while (Serial1.uart.pending() < 20) {
      others++;
      Serial1.write(0);
    }
  }
  CHECK(world.sent.size() == sent + others);
  CHECK(sketch.sensor.skippedSlots() == skipped + Slots);
}

#endif
