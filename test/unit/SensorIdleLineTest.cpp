// SBus2Sensor on a line whose next frame begins before the last slot of a group: it must not write into that frame.
#include <doctest/doctest.h>

#include <cstdint>
#include <vector>

#include "line/Line.h"
#include "support/FakeClock.h"
#include "support/KnownFrames.h"
#include "support/UartPort.h"

// After Arduino.h.
#include <SBus2Sensor.h>

namespace {

class WritePort : public BoardsPort {
 public:
  using UartPort::begin;
  size_t write(uint8_t) override {
    writes.push_back(fakeMicros);
    return 1;
  }
  using Print::write;
  std::vector<uint64_t> writes;
};

}  // namespace

TEST_CASE("no answer begins while a frame is on the wire, whatever the receiver's period") {
  for (const uint64_t periodUs : {7000u, 8000u, 9000u, 10000u, 15000u}) {
    CAPTURE(periodUs);
    fakeMicros = 0;
    WritePort port;
    SBus2Sensor sensor(port);
    sensor.begin();
    for (const uint8_t slot : {uint8_t{7}, uint8_t{15}, uint8_t{23}, uint8_t{31}}) {
      CHECK(sensor.writeSensor(slot, sbus::TemperatureF1713{20}));
    }
    std::vector<line::Character> wire;
    std::vector<uint64_t> begins;
    for (unsigned i = 0; i < 400; i++) {
      begins.push_back(20000 + i * periodUs);
      uint64_t us = begins.back();
      for (const uint8_t value : plainFrame(i, static_cast<uint8_t>(4 + 16 * (i % 4)))) {
        us += line::CharacterUs;
        line::Character character;
        character.endUs = us;
        character.value = value;
        wire.push_back(character);
      }
    }
    size_t next = 0;
    while (fakeMicros < 20000 + 400 * periodUs) {
      fakeMicros += 40;
      while (next < wire.size() && wire[next].endUs <= fakeMicros) {
        port.receive(wire[next++]);
      }
      port.advance(fakeMicros);
      sensor.parseSBusFrame();
    }
    unsigned into = 0;
    for (const uint64_t us : port.writes) {
      if (us >= 20000) {
        into += (us - 20000) % periodUs + 360 > periodUs || (us - 20000) % periodUs < 3000;
      }
    }
    MESSAGE("period ", periodUs, ": frames ", sensor.counters().frames, ", characters written ", port.writes.size(),
            ", into a frame ", into);
    CHECK(into == 0);
  }
}
