// A sketch with a DecodeSBusBackground on a port of one core, CORE, and what must hold of it.
#pragma once

#include <DecodeSBusBackground.h>

#include "Cores.h"
#include "support/KnownFrames.h"

using namespace cores;

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
  ~SketchOf() { sbus.end(); }

  void line(unsigned count, uint64_t everyUs) {
    frames = count;
    periodUs = everyUs;
    startUs = world.nowUs + 5 * Ms;
    putOnLine(count, 100000, Core.inverts, everyUs);
  }
  uint64_t endUs() const { return startUs + frames * periodUs + 10 * Ms; }

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
