// The timer, alarm or task of one core, CORE, that polls for DecodeSBusBackground: whom it polls, when it is free, and
// who waits for whom.
#include "BackgroundSketch.h"
#include <DecodeSBus32.h>
#if defined(CORE_TEENSY)
#include <IntervalTimer.h>
#endif

namespace {

struct Counted : sbus::PolledByTimer {
  unsigned polls = 0;
  void start() {
    startPolling([](sbus::PolledByTimer &decoder) {
      static_cast<Counted &>(decoder).polls++;
      return true;
    });
  }
  void stop() { stopPolling(); }
};

}  // namespace

TEST_CASE("several decoders are each polled once a millisecond, in whatever order they begin and end") {
  Sketch sketch;
  sketch.sbus.end();
  Counted counted[3];
  std::minstd_rand random{20182};
  bool runs[3] = {};
  for (unsigned round = 0; round < 500; round++) {
    const size_t one = random() % 3;
    runs[one] = random() % 2 == 0;
    counted[one].stop();  // as begin() does
    if (runs[one]) {
      counted[one].start();
    }
    for (Counted &each : counted) {
      each.polls = 0;
    }
    delay(20);
    for (size_t i = 0; i < 3; i++) {
      CHECK(counted[i].polls >= (runs[i] ? 19 : 0));
      CHECK(counted[i].polls <= (runs[i] ? 21 : 0));
    }
  }
  for (Counted &each : counted) {
    each.stop();
  }
}

#if defined(ARDUINO_ARCH_RP2040)

TEST_CASE("after end() the alarm is free; without a free one, and on the other core, parseSBusFrame() receives") {
  for (const bool isOtherCore : {false, true}) {
    CAPTURE(isOtherCore);
    Sketch sketch;
    CHECK(sim::alarms.claimed == (8 | 1));
    CHECK(sim::alarms.priority[0] == 0xFF);
    Counted counted;
    if (isOtherCore) {
      sim::alarms.core = 1;
      counted.start();
      delay(10);
      CHECK(counted.polls == 0);
      sim::alarms.core = 0;
    }
    sketch.sbus.end();
    CHECK(sim::alarms.claimed == 8);
    CHECK(sim::alarms.priority[0] == 0x80);
    CHECK(world.alarmAtUs == +sim::World::Never);
    sim::alarms.claimed = 15;
    sketch.sbus.begin();
    sketch.line(100, 9000);
    sketch.run([&] {
      delay(3);
      sketch.sbus.parseSBusFrame();
    });
    sketch.checkAll();
    CHECK(sim::alarms.claimed == 15);
  }
}

TEST_CASE("if loop() is in the port's own methods nearly always, every frame comes") {
  for (const unsigned portUs : {1u, 2u, 5u}) {
    CAPTURE(portUs);
    Sketch sketch;
    world.portUs = portUs;
    sketch.line(300, 7000);
    sketch.run([&] {
      for (int i = 0; i < 1000; i++) {
        Serial1.peek();
        world.pass(i % 10 == 0);
      }
    });
    sketch.checkAll();
  }
}

#elif defined(CORE_TEENSY)

TEST_CASE("after end() the IntervalTimer is free; without a free one parseSBusFrame() receives") {
  Sketch sketch;
  sketch.sbus.end();
  CHECK(world.alarmAtUs == +sim::World::Never);
  IntervalTimer others[4];
  for (IntervalTimer &each : others) {
    CHECK(each.begin([] {}, 100000));
  }
  sketch.sbus.begin();
  sketch.line(100, 9000);
  sketch.run([&] {
    delay(3);
    sketch.sbus.parseSBusFrame();
  });
  sketch.checkAll();
}

TEST_CASE(
    "an IntervalTimer of the sketch above the UART's priority does not let the port be read within its interrupt") {
  Sketch sketch;
  IntervalTimer other;
  other.priority(0);
  other.begin([] {}, 700);
  sketch.line(500, 7000);
  sketch.run([&] { delay(5); });
  sketch.checkAll();
}

#elif defined(ESP32)

TEST_CASE("each method that loop() calls waits for the task, which may be in the middle of a frame") {
  SketchOf<DecodeSBusBackgroundOf<DecodeSBus32> > sketch;
  uint16_t channels[18];
  bool failsafe, lostFrame;
  const DecodeSBusBackgroundOf<DecodeSBus32> &constant = sketch.sbus;
  const auto locks = [](auto method) {
    const unsigned before = world.locks;
    method();
    return world.locks - before;
  };
  CHECK(locks([&] { sketch.sbus.SBusFrameOk(); }) == 1);
  CHECK(locks([&] { sketch.sbus.decodeSBusFrame(channels, failsafe, lostFrame); }) == 1);
  CHECK(locks([&] { sketch.sbus.decodeExtraChannels(channels); }) == 1);
  CHECK(locks([&] { sketch.sbus.newFrame(); }) == 1);
  CHECK(locks([&] { sketch.sbus.linkState(); }) == 1);
  CHECK(locks([&] { sketch.sbus.frameAge(); }) == 1);
  CHECK(locks([&] { constant.counters(); }) == 1);
  CHECK(locks([&] { sketch.sbus.setLossLimit(50); }) == 1);
  CHECK(locks([&] { sketch.sbus.parseSBusFrame(); }) == 1);
  CHECK(locks([&] { sketch.sbus.end(); }) == 1);
}

TEST_CASE("while begin() opens the port, the task of esp_timer does not wait for it") {
  Sketch sketch;
  const unsigned before = world.locks;
  sketch.sbus.begin();
  CHECK(world.locks - before <= 3);
  CHECK(world.locked == 0);
}

TEST_CASE("after end() the timer is not armed again") {
  Sketch sketch;
  sketch.sbus.end();
  delay(5);
  CHECK(world.alarmAtUs == +sim::World::Never);
}

#endif
