// DecodeSBusBackground on the ports of one core, CORE: whatever loop() does, and whatever holds up the interrupt or the
// task that polls, no frame is wrong, and frames are lost only where the port itself loses bytes.
#include <DecodeSBusBackground.h>
#include <DecodeSBusTelemetry.h>

#include "Cores.h"
#include "support/KnownFrames.h"
#if defined(ARDUINO_ARCH_RP2040)
#include "PicoAlarms.h"
#elif !defined(ESP32)
#include "Ticks.h"
#endif
#if defined(CORE_TEENSY)
#include <IntervalTimer.h>
#endif

decltype(Serial1) Serial1, Serial2;

using namespace cores;

namespace {

constexpr uint64_t Ms = 1000;  // us

// While loop() is in a method nothing else may read.
struct Unheld : sim::Reader {
  bool inMethod = false;
  void beforeRead() override { world.crashes += world.inAlarm && inMethod; }
};

template <typename Decoder>
struct SketchOf {
  Unheld unheld;
  Decoder sbus{Serial1};
  uint64_t startUs = 0, periodUs = 0;
  unsigned frames = 0;
  unsigned wrong = 0;  // not on the line like that, or not the newest or the one before

  SketchOf() {
    cores::switchOn();
#if defined(ARDUINO_ARCH_RP2040)
    sim::alarms = sim::Alarms();
#elif defined(ESP32)
    world.alarmWaits = false;
#else
    sim::startTicks();
#endif
    world.tickUs = 1;
    world.reader = &unheld;
    sbus.begin();
  }
  ~SketchOf() {
    sbus.end();
  }

  void line(unsigned count, uint64_t everyUs) {
    frames = count;
    periodUs = everyUs;
    startUs = world.nowUs + 5 * Ms;
    putOnLine(count, 100000, Core.inverts, everyUs);
  }
  uint64_t endUs() const {
    return startUs + frames * periodUs + 10 * Ms;
  }

  template <typename Method>
  void call(Method method) {
    unheld.inMethod = true;
    method();
    unheld.inMethod = false;
  }

  void look() {
    Channels channels{};
    bool failsafe, lostFrame;
    call([&] { sbus.decodeSBusFrame(channels.data(), failsafe, lostFrame); });
    if (!failsafe && !lostFrame) {
      const unsigned number = channels[0] - 900u;
      const unsigned complete = static_cast<unsigned>((world.nowUs - startUs + periodUs - 3 * Ms) / periodUs);
      wrong += channels != channelsOf(number) || number >= complete;
    }
  }

  template <typename Loop>
  void run(Loop loop) {
    while (world.nowUs < endUs()) {
      loop();
      look();
    }
    CHECK(wrong == 0);
    CHECK(world.crashes == 0);
  }

  // Checks after run() that no frame is missing.
  void checkAll() {
    const sbus::Counters counters = sbus.counters();
    CHECK(counters.frames == frames);
    CHECK(counters.discardedBytes == 0);
    CHECK(counters.overflows == 0);
  }
};

using Sketch = SketchOf<DecodeSBusBackground>;

}  // namespace

TEST_CASE("every frame comes, whether loop() is in delay(1) to delay(20), or in delay(500)") {
  for (const uint64_t periodUs : {4000, 6300, 7000, 9000, 14000, 15000}) {
    for (const unsigned blockedMs : {1, 2, 3, 4, 5, 7, 9, 12, 20, 500}) {
      CAPTURE(periodUs);
      CAPTURE(blockedMs);
      Sketch sketch;
      sketch.line(200, periodUs);
      sketch.run([&] { delay(blockedMs); });
      sketch.checkAll();
    }
  }
}

TEST_CASE("every frame comes while loop() calls methods all the time, and nothing reads the port meanwhile") {
  for (const bool parses : {false, true}) {
    CAPTURE(parses);
    Sketch sketch;
    sketch.line(200, 7000);
    sketch.run([&] {
      sketch.call([&] { sketch.sbus.newFrame(); });
      sketch.call([&] { sketch.sbus.linkState(); });
      sketch.call([&] { sketch.sbus.SBusFrameOk(); });
      sketch.call([&] { sketch.sbus.frameAge(); });
      sketch.call([&] { sketch.sbus.counters(); });
      sketch.call([&] { sketch.sbus.setLossLimit(100); });
      if (parses) {
        sketch.sbus.parseSBusFrame();
      }
    });
    sketch.checkAll();
  }
}

TEST_CASE("with other interrupts or tasks of up to 5 ms no frame is wrong, and up to 1 ms none is lost") {
  for (const unsigned randomUs : {50u, 300u, 1000u, 5000u}) {
    for (const uint64_t periodUs : {6300, 7000, 9000, 14000}) {
      CAPTURE(randomUs);
      CAPTURE(periodUs);
      Sketch sketch;
      world.randomUs = randomUs;
      world.portUs = 3;
      sketch.line(1000, periodUs);
      sketch.run([&] { delay(3); });
      MESSAGE(sketch.sbus.counters().frames, " of ", sketch.frames);
      CHECK((randomUs > 1000 || sketch.sbus.counters().frames == sketch.frames));
    }
  }
}

TEST_CASE("while loop() disables interrupts for up to 3 ms, all frames come") {
  for (const unsigned maskedUs : {90u, 1000u, 3000u}) {
    CAPTURE(maskedUs);
    Sketch sketch;
    sketch.line(300, 9000);
    sketch.run([&] {
      delayMicroseconds(777);
      world.masked++;
      delayMicroseconds(maskedUs);
      world.masked--;
    });
    sketch.checkAll();
  }
}

TEST_CASE("a contact that opens, and closes again within a frame with a second reading, gives no wrong frame") {
  std::minstd_rand random{20181};
  const Channels right = readBitByBit(SecondReading);
  for (const uint64_t periodUs : {6300, 7000, 9000, 14000, 15000}) {
    CAPTURE(periodUs);
    Sketch sketch;
    world.inverted = Core.inverts;
    uint64_t us = world.nowUs + 5 * Ms;
    unsigned whole = 0, wrong = 0, seen = 0;
    const auto put = [&](size_t from) {
      for (size_t i = 0; i < SecondReading.size(); i++) {
        if (i >= from) {
          line::Character character;
          character.endUs = us + (i + 1) * line::CharacterUs;
          character.value = SecondReading[i];
          world.line.push_back(character);
        }
      }
      us += periodUs;
      whole += from == 0;
    };
    for (size_t place = 1; place < SecondReading.size(); place++) {
      for (unsigned i = 0; i < 4; i++) {
        put(0);
      }
      us += 4 * Ms + random() % (46 * Ms);
      put(place);
    }
    put(0);
    put(0);
    while (world.nowUs < us + 10 * Ms) {
      delay(4);
      if (sketch.sbus.newFrame()) {
        Channels channels{};
        bool failsafe, lostFrame;
        sketch.sbus.decodeSBusFrame(channels.data(), failsafe, lostFrame);
        wrong += channels != right;
        seen++;
      }
    }
    CHECK(wrong == 0);
    CHECK(sketch.sbus.counters().frames + 24 >= whole);  // at each join one
    MESSAGE(sketch.sbus.counters().frames, " of ", whole, ", ", seen, " seen by loop()");
  }
}

TEST_CASE("after end() nothing is read; after begin(), once or twice, and listen() frames come") {
  Sketch sketch;
  sketch.sbus.end();
  DecodeSBus(Serial1).begin();
  sketch.line(100, 9000);
  delay(100);
  CHECK(Serial1.available() > 60);
  CHECK(sketch.sbus.counters().frames == 0);
  sketch.sbus.listen();
  delay(100);
  CHECK(sketch.sbus.counters().frames >= 10);
  sketch.sbus.begin();
  sketch.sbus.begin();
  delay(100);
  CHECK(sketch.sbus.counters().frames >= 10);
  CHECK(sketch.sbus.counters().frames <= 12);
}

TEST_CASE("telemetry comes in the background, with its age, and nothing reads the port meanwhile") {
  SketchOf<DecodeSBusBackgroundOf<DecodeSBusTelemetry>> sketch;
  world.inverted = Core.inverts;
  uint64_t us = world.nowUs + 5 * Ms;
  const auto put = [&us](const uint8_t *bytes, size_t count) {
    for (size_t i = 0; i < count; i++) {
      line::Character character;
      character.endUs = us += line::CharacterUs;
      character.value = bytes[i];
      world.line.push_back(character);
    }
  };
  for (unsigned i = 0; i < 20; i++) {
    constexpr uint8_t Slot[] = {0x03, 0xC0, 0x2E};
    const Frame bytes = plainFrame(i, static_cast<uint8_t>(i % 4 << 4 | 4));
    put(bytes.data(), bytes.size());
    us += 2030;
    put(Slot, i % 4 == 0 ? sizeof Slot : 0);
    us += i % 4 == 0 ? 9610 : 9970;
  }
  delay(5 + 18 * 15);
  SBusFrame frame;
  sbus::ReceiverVoltage voltage{};
  sbus::Trust trust{};
  sketch.call([&] { CHECK(sketch.sbus.read(frame)); });
  sketch.call([&] { CHECK(sketch.sbus.readSensor(0, voltage)); });
  CHECK(voltage.decivolts == 46);
  sketch.call([&] { CHECK(sketch.sbus.readSensor(0, voltage, trust)); });
  CHECK(trust.times >= 4);  // the first frame may be found late
  CHECK(trust.age >= 15 + 11);  // the newest frame but one announced it
  CHECK(trust.age <= 15 + 11 + 10);
  sketch.call([&] { CHECK(sketch.sbus.rejectedGroups() == 0); });
  CHECK(world.crashes == 0);
}

namespace {

struct Counted : sbus::Ticked {
  unsigned polls = 0;
  void start() {
    startTicks([](sbus::Ticked &ticked) {
      static_cast<Counted &>(ticked).polls++;
      return true;
    });
  }
  void stop() { stopTicks(); }
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
  Sketch sketch;
  uint16_t channels[18];
  bool failsafe, lostFrame;
  const DecodeSBusBackground &constant = sketch.sbus;
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

#endif
