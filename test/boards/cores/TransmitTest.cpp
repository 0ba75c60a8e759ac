// EncodeSBus on the ports of one core, CORE: whole frames are sent, and come back to a DecodeSBus on the same port.
#include <EncodeSBus.h>

#include <algorithm>

#include "Cores.h"

using namespace cores;

namespace {

struct Sending {
  unsigned frames = 0, waitedUs = 0;
  Delivered returned;

  // Writes for a second; `dSBus`, if any, is on the same port.
  void loop(EncodeSBus &eSBus, unsigned loopUs, DecodeSBus *dSBus = nullptr) {
    for (const uint64_t endUs = world.nowUs + 1000000; world.nowUs < endUs; world.nowUs += loopUs) {
      const Channels channels = channelsOf(frames);
      const uint64_t before = world.nowUs;
      frames += eSBus.write(channels.data(), false, false);
      waitedUs = std::max(waitedUs, static_cast<unsigned>(world.nowUs - before));
      if (dSBus != nullptr) {
        returned.poll(*dSBus);
      }
    }
    world.nowUs += 10000;
    if (dSBus != nullptr) {
      returned.poll(*dSBus);
    }
  }
};

// Checks that the bytes are whole frames, without a gap inside, and that no gap between them is shorter, as the clock
// counts.
void checkSent(unsigned frames, uint64_t gapUs) {
  gapUs -= std::min(gapUs, uint64_t{sbus::ClockStep});
  REQUIRE(world.sent.size() == frames * 25);
  unsigned wrong = 0, torn = 0, close = 0;
  for (size_t i = 0; i < world.sent.size(); i++) {
    wrong += world.sent[i].value != frameOf(static_cast<unsigned>(i / 25))[i % 25];
    const uint64_t gap =
        i == 0 ? gapUs : world.sent[i].beginUs - std::min(world.sent[i - 1].endUs, world.sent[i].beginUs);
    (i % 25 == 0 ? close : torn) += i % 25 == 0 ? gap < gapUs : gap > 2;
  }
  CHECK(wrong == 0);
  CHECK(torn == 0);
  CHECK(close == 0);
}

}  // namespace

TEST_CASE("EncodeSBus sends whole frames, with gaps, and waits 3.1 ms at most") {
  struct Row {
    uint16_t periodUs;
    unsigned loopUs, least, most;  // frames in a second
    uint64_t gapUs;
  };
  for (const Row &row : {Row{9000, 50, 111, 112, 5900}, Row{9000, 1000, 111, 112, 3900}, Row{4000, 50, 249, 250, 850},
                         Row{1000, 50, 250, 450, 0}}) {
    CAPTURE(row.periodUs);
    CAPTURE(row.loopUs);
    switchOn();
    EncodeSBus eSBus(SBUS_PORT);
    eSBus.begin();
    eSBus.setPeriod(row.periodUs);
    Sending sending;
    sending.loop(eSBus, row.loopUs);
    checkSent(sending.frames, row.gapUs);
    CHECK(sending.frames * (row.periodUs + sbus::ClockStep) >= row.least * row.periodUs);
    CHECK(sending.frames <= row.most);
    CHECK(sending.waitedUs <= (row.periodUs >= 4000 ? Core.waitsUs : Core.counts ? 0 : 3100));
    const sim::Settings &settings = world.sent[0].settings;
    CHECK(settings.baud >= 100000);
    CHECK(settings.baud < 101000);  // a Due
    CHECK(settings.evenStops == Core.stops);
    CHECK(settings.txInverted == Core.inverts);
    CHECK(world.crashes == 0);
  }
}

TEST_CASE("end() lets the frame go out that write() has taken") {
  switchOn();
  EncodeSBus eSBus(SBUS_PORT);
  eSBus.begin();
  const Channels channels = channelsOf(0);
  CHECK(eSBus.write(channels.data(), false, false));
  eSBus.end();
  checkSent(1, 0);
}

TEST_CASE("a Stream with room for less than a frame also gets whole frames") {
  switchOn();
  Software software(15);
  EncodeSBus eSBus(software);
  Sending sending;
  sending.loop(eSBus, 50);
  checkSent(sending.frames, 5900);
  CHECK(sending.frames >= 111);
  CHECK(sending.waitedUs == 1200);
}

TEST_CASE("what EncodeSBus sends comes back to a DecodeSBus on the same port") {
  for (const unsigned loopUs : {50u, 1000u, 3000u}) {
    CAPTURE(loopUs);
    switchOn();
    world.looped = true;
    DecodeSBus dSBus(SBUS_PORT);
    EncodeSBus eSBus(SBUS_PORT);
    dSBus.begin();
    Sending sending;
    sending.loop(eSBus, loopUs, &dSBus);
    CHECK(sending.frames >= 110);
    CHECK(sending.returned.numbers == allOf(sending.frames));
    CHECK(sending.returned.wrong == 0);
    CHECK(dSBus.counters().overflows == 0);
    CHECK(world.crashes == 0);
  }
}
