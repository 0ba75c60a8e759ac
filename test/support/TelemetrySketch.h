// A DecodeSBusTelemetry in a sketch, and the S.BUS2 line that it reads: a receiver with two sensors.
#pragma once

#include <doctest/doctest.h>

#include <cstdint>
#include <functional>
#include <vector>

#include "Bytes.h"
#include "KnownFrames.h"
#include "UartPort.h"

// After Arduino.h.
#include <DecodeSBusTelemetry.h>

constexpr uint32_t PeriodUs = 15000;
constexpr uint32_t ToSlotsUs = 2030;  // from the frame's end: PX4's capture
constexpr uint32_t PitchUs = 660;

struct Answer {
  uint8_t slot;
  Bytes characters;
};

// A receiver with an SBS-01V in slots 1 and 2 and a CURR-F1678 in 24 to 26; a test may change what they send.
struct Bus {
  bool hasBreaks = false;  // 00 after the frame and after each answer
  std::function<void(unsigned round, std::vector<Answer> &)> change = [](unsigned, std::vector<Answer> &) {};

  // Changes what the receiver and the SBS-01V send, slots 0 to 2.
  void changeFirst(const std::function<void(std::vector<Answer> &)> &work) {
    change = [work](unsigned, std::vector<Answer> &answers) {
      if (!answers.empty() && answers[0].slot == 0) {
        work(answers);
      }
    };
  }

  std::vector<Answer> answers(unsigned group, unsigned round) const {
    std::vector<Answer> all;
    if (group == 0) {
      all = {{0, {0x03, static_cast<uint8_t>(round % 2 == 0 ? 0xC0 : 0xC4), 0x2E}},  // 4.6 V, PX4's capture
             {1, {0x83, 0x80, 0x38}},                                                // 5.6 V, msrc#173
             {2, {0x43, 0x00, 0x7D}}};                                               // 12.5 V
    } else if (group == 3) {
      all = {{24, {0x1B, 0x49, 0x29}}, {25, {0x9B, 0x04, 0xD2}}, {26, {0x5B, 0x05, 0xDC}}};  // BrushlessPower
    }
    change(round, all);
    return all;
  }
};

// A user-defined sensor.
template <uint8_t Count>
struct Raw {
  static constexpr uint8_t Slots = Count;
  uint8_t data0 = 0;  // of the first slot
  void decode(const sbus::SlotData *slots) { data0 = slots[0].data0; }
};

template <uint8_t Count>
bool hasSlots(DecodeSBusTelemetry &sbus, uint8_t first) {
  Raw<Count> raw;
  return sbus.readSensor(first, raw);
}

// Returns data0 of a slot that must have come.
inline unsigned data0Of(DecodeSBusTelemetry &sbus, uint8_t slot) {
  Raw<1> raw;
  REQUIRE(sbus.readSensor(slot, raw));
  return raw.data0;
}

// A sketch with a loop of some period, and the line that it reads.
struct Sketch {
  UartPort port;
  DecodeSBusTelemetry sbus{port};
  uint32_t loopUs;
  uint64_t loopedUs;

  explicit Sketch(uint32_t loop, const Driver &driver = Board)
      : port(sbus::Baud, driver), loopUs(loop), loopedUs(fakeMicros) {
    sbus.begin();
  }

  void runTo(uint64_t us) {
    for (; loopedUs + loopUs <= us; loopedUs += loopUs) {
      fakeMicros = loopedUs + loopUs;
      port.advance(fakeMicros);
      sbus.parseSBusFrame();
    }
  }

  void hear(uint64_t startUs, const Bytes &bytes) {
    for (size_t i = 0; i < bytes.size(); i++) {
      line::Character character;
      character.endUs = startUs + 120 * (i + 1);
      character.value = bytes[i];
      runTo(character.endUs);
      port.receive(character);
    }
  }

  // Runs for this many rounds of four frames each, 60 ms.
  void rounds(unsigned count, const Bus &bus = {}) {
    for (unsigned round = 0; round < count; round++) {
      for (unsigned group = 0; group < 4; group++) {
        const uint64_t startUs = nextUs;
        nextUs += PeriodUs;
        const Bytes behind(bus.hasBreaks ? 1 : 0, 0x00);
        hear(startUs, bytesOf(plainFrame(frames++, static_cast<uint8_t>(group << 4 | 4))) + behind);
        for (const Answer &answer : bus.answers(group, round)) {
          hear(startUs + 25 * 120 + ToSlotsUs + PitchUs * (answer.slot % 8), answer.characters + behind);
        }
        runTo(nextUs - 1);
      }
    }
  }

  uint64_t nextUs = fakeMicros + 20000;
  unsigned frames = 0;
};

inline bool hasVoltage(Sketch &sketch) {
  sbus::VoltageSbs01V voltage{4711, 4711};
  const bool has = sketch.sbus.readSensor(1, voltage);
  CHECK(voltage.batteryDecivolts == (has ? 56 : 4711));
  CHECK(voltage.externalDecivolts == (has ? 125 : 4711));
  return has;
}

inline bool hasCurrent(Sketch &sketch) {
  sbus::CurrentF1678 current{4711, 4711, 4711};
  const bool has = sketch.sbus.readSensor(24, current);
  CHECK(current.centiamperes == (has ? 2345 : 4711));
  CHECK(current.centivolts == (has ? 1234 : 4711));
  CHECK(current.milliampereHours == (has ? 1500 : 4711));
  return has;
}
