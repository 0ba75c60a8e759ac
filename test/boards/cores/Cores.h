// What the tests of a core, CORE, have in common: its port, a line to it, and what is delivered of that.
#pragma once

#include <Arduino.h>
#include <DecodeSBus.h>
#include <doctest/doctest.h>

#include <new>
#include <numeric>
#include <vector>

#include "World.h"
#include "support/BitByBit.h"

namespace doctest {

template <>
struct StringMaker<std::vector<unsigned>> {
  static String convert(const std::vector<unsigned> &numbers) {
    String text;
    for (const unsigned number : numbers) {
      text += toString(number) + " ";
    }
    return text;
  }
};

}  // namespace doctest

namespace cores {

using sim::world;
using Numbers = std::vector<unsigned>;  // of frames, from 0 on

// Core 1 of the ESP32 cannot be told a smaller one.
#if defined(ESP32) && ESP32_CORE == 1
constexpr unsigned MostBurst = 112;
#else
constexpr unsigned MostBurst = 16;
#endif
constexpr uint32_t Uninverted = static_cast<uint32_t>(sbus::Uninverted);

// Switches the board on.
inline void switchOn() {
  const uint64_t now = world.nowUs;
  world = sim::World();
  world.nowUs = now;
#if defined(CLOCK_HZ)
  world.clockHz = CLOCK_HZ;
#endif
  using Port = decltype(SBUS_PORT);
  new (&SBUS_PORT) Port();
}

// CH1, CH3 and CH16 count: no parts of two frames make a third.
inline Channels channelsOf(unsigned number) {
  Channels channels;
  channels.fill(992);
  channels[16] = channels[17] = 0;
  channels[0] = static_cast<uint16_t>(900 + number);
  channels[2] = channels[15] = static_cast<uint16_t>(300 + number);
  return channels;
}

inline Frame frameOf(unsigned number) { return writeBitByBit(channelsOf(number)); }

inline void putOnLine(unsigned frames, unsigned long baud, bool inverted, uint64_t periodUs) {
  world.baud = baud;
  world.inverted = inverted;
  const uint64_t characterUs = 12 * 1000000 / baud;
  for (unsigned number = 0; number < frames; number++) {
    uint64_t us = world.nowUs + 5000 + number * periodUs;
    for (const uint8_t byte : frameOf(number)) {
      us += characterUs;
      world.line.push_back({us, byte});
    }
  }
}

struct Delivered : sim::Reader {
  DecodeSBus *asked = nullptr;
  Numbers numbers;
  unsigned wrong = 0;       // were not on the line like that, or not yet, or out of order
  unsigned tooYoung = 0;    // polls after which the age was below the time since the newest frame's last byte
  unsigned lossyPolls = 0;  // before which the port has lost bytes

  void poll(DecodeSBus &dSBus) {
    const unsigned long before = world.dropped;
    asked = &dSBus;
    world.reader = this;
    dSBus.parseSBusFrame();
    world.reader = nullptr;
    beforeRead();
    if (!numbers.empty() && numbers.back() < world.line.size() / 25) {
      tooYoung += (dSBus.frameAge() + 1) * 1000 <= world.nowUs - world.line[numbers.back() * 25 + 24].endUs;
    }
    lossyPolls += world.dropped != before;
  }

  void beforeRead() override {
    if (!asked->newFrame()) {
      return;
    }
    Channels channels{};
    bool failsafe, lostFrame;
    asked->decodeSBusFrame(channels.data(), failsafe, lostFrame);
    const unsigned number = channels[0] - 900u;
    const bool known = channels == channelsOf(number) && world.next >= (number + 1) * 25 &&
                       (numbers.empty() || number > numbers.back());
    wrong += !known || failsafe || lostFrame;
    numbers.push_back(number);
  }

  // Loops until the line has ended. Each loop takes `loopUs`, now and then `blockedUs` more.
  void loop(DecodeSBus &dSBus, unsigned loopUs, unsigned blockedUs = 0) {
    const uint64_t endUs = world.line.back().endUs + 10000;
    for (uint64_t nextBlock = world.nowUs + 150000; world.nowUs < endUs; world.nowUs += loopUs) {
      poll(dSBus);
      if (blockedUs != 0 && world.nowUs >= nextBlock) {
        world.nowUs += blockedUs;
        nextBlock = world.nowUs + 151300;
      }
    }
  }
};

inline Numbers allOf(unsigned frames) {
  Numbers numbers(frames);
  std::iota(numbers.begin(), numbers.end(), 0u);
  return numbers;
}

// Stands for a SoftwareSerial, or any other Stream.
class Software : public Simulated<Stream> {
 public:
  explicit Software(unsigned transmitter) : Simulated<Stream>({63, 1, 1, transmitter, 0, false, 0}) {
    uart.open({100000, 2, false, false});
  }
#if defined(PRINT_WITHOUT_ROOM)
  int availableForWrite() { return uart.room(); }
#else
  int availableForWrite() override { return uart.room(); }
#endif
};

}  // namespace cores
