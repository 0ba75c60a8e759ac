// DecodeSBusBackground on the ports of one core, CORE: whatever loop() does, and whatever holds up the interrupt or the
// task that polls, no frame is wrong, and frames are lost only where the port itself loses bytes.
#include <DecodeSBusTelemetry.h>
#include <sbus/LinkQuality.h>

#include "BackgroundSketch.h"

decltype(Serial1) Serial1, Serial2;

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

template <typename Decoder>
void openAnything(Decoder &decoder) {
  decoder.begin();
}

TEST_CASE("a template opens it as it opens a DecodeSBus: frames come, and LinkQuality knows how many") {
  Sketch sketch;
  sketch.sbus.end();
  openAnything(sketch.sbus);
  sketch.line(100, 9000);
  sbus::LinkQuality quality;
  uint8_t percent = 0;
  for (int i = 0; i < 5; i++) {
    delay(100);
    sketch.call([&] { percent = quality.update(sketch.sbus); });
  }
  CHECK(sketch.sbus.counters().frames >= 50);
  CHECK(percent == 100);
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
  CHECK(trust.times >= 4);      // the first frame may be found late
  CHECK(trust.age >= 15 + 11);  // the newest frame but one announced it
  CHECK(trust.age <= 15 + 11 + 10);
  sketch.call([&] { CHECK(sketch.sbus.rejectedGroups() == 0); });
  CHECK(world.crashes == 0);
}
