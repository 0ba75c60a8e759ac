// DecodeSBus on the ports of one core, CORE: every frame comes, and none is made of parts of two.
#include <string>

#include "Cores.h"

#if defined(ESP8266)
HardwareSerial Serial, Serial1(1);
#else
decltype(Serial1) Serial1;
Console Serial;
#endif

using namespace cores;

namespace {

struct Opening {
  const char *name;
  void (*open)(DecodeSBus &dSBus);
  unsigned long baud;
  bool inverted;
  bool byHand;  // opened by the sketch
};

const Opening Openings[] = {
    {"begin()", [](DecodeSBus &dSBus) { dSBus.begin(); }, 100000, Core.inverts, false},
    {"begin(), twice",
     [](DecodeSBus &dSBus) {
       dSBus.begin();
       dSBus.begin();
     },
     100000, Core.inverts, false},
    {"begin(), end(), begin()",
     [](DecodeSBus &dSBus) {
       dSBus.begin();
       dSBus.end();
       dSBus.begin();
     },
     100000, Core.inverts, false},
    {"begin(100000, SERIAL_8E2), begin()",
     [](DecodeSBus &dSBus) {
       dSBus.begin(100000, Uninverted);
       dSBus.begin();
     },
     100000, Core.inverts, false},
    {"begin(0), begin()",
     [](DecodeSBus &dSBus) {
       dSBus.begin(0);
       CHECK_FALSE(SBUS_PORT.uart.isOpen());
       dSBus.begin();
     },
     100000, Core.inverts, false},
    {"begin(200000)", [](DecodeSBus &dSBus) { dSBus.begin(200000); }, 200000, Core.inverts, false},
    {"begin(100000, SERIAL_8E2)", [](DecodeSBus &dSBus) { dSBus.begin(100000, Uninverted); }, 100000, false, false},
#if defined(PORT_INVEN_bm)
    {"begin(), the pin inverts",
     [](DecodeSBus &dSBus) {
       dSBus.begin();
       PORTC.PIN5CTRL |= PORT_INVEN_bm;
     },
     100000, true, false},
    {"the pin inverts, begin(), something sent, begin(200000)",
     [](DecodeSBus &dSBus) {
       PORTC.PIN5CTRL |= PORT_INVEN_bm;
       dSBus.begin();
       SBUS_PORT.write(0);
       dSBus.begin(200000);
     },
     200000, true, false},
#endif
#if defined(OPENED_BY_HAND)
    {"listen(), opened as the core expects it",
     [](DecodeSBus &dSBus) {
       openByHand();
       dSBus.listen();
     },
     100000, Core.inverts, true},
#else
    {"listen(), opened uninverted",
     [](DecodeSBus &dSBus) {
       SBUS_PORT.begin(100000, sbus::Uninverted);
       dSBus.listen();
     },
     100000, false, true},
#endif
};

}  // namespace

TEST_CASE("every frame is delivered, in order, and nothing overflows") {
  constexpr unsigned Frames = 60;
  for (const Opening &opening : Openings) {
    for (const unsigned periodUs : {7000u, 9000u, 14000u}) {
      for (const unsigned loopUs : {50u, 1000u, 3000u}) {
        INFO(opening.name);
        CAPTURE(periodUs);
        CAPTURE(loopUs);
        switchOn();
        DecodeSBus dSBus(SBUS_PORT);
        opening.open(dSBus);
        putOnLine(Frames, opening.baud, opening.inverted, periodUs);
        Delivered delivered;
        delivered.loop(dSBus, loopUs);
        CHECK(delivered.numbers == allOf(Frames));
        CHECK(delivered.wrong == 0);
        CHECK(delivered.tooYoung == 0);
        CHECK(dSBus.counters().overflows == 0);
        CHECK((opening.byHand || SBUS_PORT.uart.burst() <= MostBurst));
        CHECK(world.crashes == 0);
      }
    }
  }
}

TEST_CASE("nothing is delivered from a line of the other polarity") {
  for (const Opening &opening : Openings) {
    INFO(opening.name);
    switchOn();
    DecodeSBus dSBus(SBUS_PORT);
    opening.open(dSBus);
    putOnLine(10, opening.baud, !opening.inverted, 9000);
    Delivered delivered;
    delivered.loop(dSBus, 1000);
    CHECK(delivered.numbers == Numbers{});
  }
}

TEST_CASE("what waits when begin() is called is of an unknown age, and is no frame, whether or not the core keeps it") {
  switchOn();
  DecodeSBus dSBus(SBUS_PORT);
  dSBus.begin();
  putOnLine(2, 100000, Core.inverts, 9000);
  world.pass(1000000);
  CHECK(SBUS_PORT.available() > 0);
  dSBus.begin();
  for (unsigned i = 0; i < 100; i++) {
    dSBus.parseSBusFrame();
    world.pass(50);
  }
  CHECK(dSBus.counters().frames == 0);
  CHECK(dSBus.frameAge() == ULONG_MAX);
}

TEST_CASE(
    "with a loop() blocked for up to 100 ms no frame is wrong, and only frames that do not fit the port are lost") {
  constexpr unsigned Frames = 150;
  for (const unsigned periodUs : {7000u, 9000u, 14000u}) {
    for (const unsigned loopUs : {50u, 1000u, 3000u}) {
      for (const bool byHand : {false, true}) {
        CAPTURE(periodUs);
        CAPTURE(loopUs);
        CAPTURE(byHand);
        for (const unsigned blockedUs : {12000u, 30000u, 100000u}) {
          CAPTURE(blockedUs);
          switchOn();
          DecodeSBus dSBus(SBUS_PORT);
          const Opening *const opening = byHand ? std::end(Openings) - 1 : Openings;
          opening->open(dSBus);
          dSBus.setTimeout(0);  // frames that waited meanwhile count, however old they are
          putOnLine(Frames, 100000, opening->inverted, periodUs);
          Delivered delivered;
          delivered.loop(dSBus, loopUs, blockedUs);
          CHECK(delivered.wrong == 0);
          // A loss tears a frame before it and a frame after it. Bytes that wait behind the buffer are not read: they
          // may be from before the loss or after it.
          const unsigned tornEach = 2 + SBUS_PORT.uart.behind() / 25;
          CHECK(Frames - delivered.numbers.size() <= world.dropped / 25 + tornEach * dSBus.counters().overflows);
          CHECK(dSBus.counters().overflows >= delivered.lossyPolls);
          CHECK(dSBus.counters().overflows <= Frames * periodUs / (151300 + blockedUs) + 1);
        }
      }
    }
  }
}

TEST_CASE("a buffer that overflows within a frame joins no parts of two frames, however many bytes it loses") {
  constexpr unsigned Frames = 40, InSync = 5;
  unsigned delivered = 0, wrong = 0;
  for (unsigned cut = 1; cut < 25; cut++) {
    for (int spare = 40; spare > -60; spare--) {
      switchOn();
      DecodeSBus dSBus(SBUS_PORT);
      Openings[0].open(dSBus);
      dSBus.setTimeout(0);
      putOnLine(Frames, 100000, Openings[0].inverted, 4000);
      Delivered frames;
      const unsigned last = InSync * 25 + cut - 1;
      for (; world.nowUs < world.line[last].endUs; world.nowUs += 500) {
        frames.poll(dSBus);
      }
      world.nowUs = world.line[last].endUs;
      frames.poll(dSBus);
      const unsigned fits = SBUS_PORT.uart.size() + SBUS_PORT.uart.behind();
      world.nowUs = world.line[last + fits - static_cast<unsigned>(spare)].endUs;
      world.lateUs = spare % 2 == 0 ? 4500 : 0;
      frames.loop(dSBus, 500);
      delivered += static_cast<unsigned>(frames.numbers.size());
      wrong += frames.wrong;
    }
  }
  CHECK(wrong == 0);
  CHECK(delivered > 24 * 100 * InSync);
}

TEST_CASE("a Stream that is no hardware serial port delivers frames, and begin() does not change it") {
  for (const unsigned loopUs : {50u, 1000u, 3000u}) {
    CAPTURE(loopUs);
    switchOn();
    Software software(63);
    DecodeSBus dSBus(software);
    loopUs == 50 ? dSBus.begin() : dSBus.listen();
    putOnLine(60, 100000, false, 9000);
    Delivered delivered;
    delivered.loop(dSBus, loopUs);
    CHECK(delivered.numbers == allOf(60));
    CHECK(delivered.wrong == 0);
    CHECK(dSBus.counters().overflows == 0);
    CHECK_FALSE(sbus::inverts(software));
  }
}

TEST_CASE("inverts() returns whether the port can invert") { CHECK(sbus::inverts(SBUS_PORT) == Core.inverts); }

#if defined(ESP32)
TEST_CASE("an ESP32's port does not say when a frame ended: SlotTimer finds that out") {
  const sbus::ReceiveNotice notice = sbus::CoreKind::Notice;
  CHECK(notice == sbus::ReceiveNotice::Unknown);
}
#endif

TEST_CASE("a character with an error: on a core that discards it the frame is missing, on others the frame is wrong") {
  constexpr unsigned Frames = 60;
  for (const unsigned error : {sim::Parity, sim::Framing}) {
    for (const unsigned loopUs : {50u, 1000u, 3000u}) {
      CAPTURE(error);
      CAPTURE(loopUs);
      switchOn();
      DecodeSBus dSBus(SBUS_PORT);
      Openings[0].open(dSBus);
      putOnLine(Frames, 100000, Openings[0].inverted, 9000);
      world.error = error;
      Numbers whole;
      for (unsigned number = 0; number < Frames; number++) {
        if (number % 10 == 5) {
          line::Character &character = world.line[number * 25 + 10];
          character.value ^= 0x10;
          character.bad = true;
        } else {
          whole.push_back(number);
        }
      }
      Delivered delivered;
      delivered.loop(dSBus, loopUs);
      const bool discards = SBUS_PORT.uart.discards(error);
      CHECK(delivered.numbers == (discards ? whole : allOf(Frames)));
      CHECK(delivered.wrong == (discards ? 0 : Frames / 10));
    }
  }
}

TEST_CASE("README.md's ten lines print the throttle of every frame, and 0 before the first") {
  constexpr unsigned Frames = 60;
  switchOn();
#if defined(PINS_GIVEN)
  constexpr int Given[] = {PINS_GIVEN};
  world.pin = Given[0];  // as src/SBusBoard.h has it
#endif
  setup();
  putOnLine(Frames, 100000, Core.inverts, 9000);
  while (world.nowUs < world.line.back().endUs + 10000) {
    loop();
  }
  CHECK(world.printed.substr(0, 3) == "0\r\n");
  Numbers printed;
  for (size_t at = 0, end; (end = world.printed.find("\r\n", at)) != std::string::npos; at = end + 2) {
    const std::string line = world.printed.substr(at, end - at);
    if (line == "0") {
      CHECK(printed.empty());
      continue;
    }
    const unsigned number = static_cast<unsigned>(std::stoul(line)) - 300;
    if (printed.empty() || number != printed.back()) {
      printed.push_back(number);
    }
  }
  CHECK(printed == allOf(Frames));
}
