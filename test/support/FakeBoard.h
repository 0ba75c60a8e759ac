// A DecodeSBus on a FakeSerial, and what a sketch does with them.
#pragma once

#include "Bytes.h"
#include "FakeClock.h"
#include "FakeSerial.h"

#include <DecodeSBus.h>

constexpr uint64_t Ms = 1000;  // us

struct Decoded {
  Channels channels;
  bool failsafe;
  bool lostFrame;
};

// What the channels of a sketch hold before a frame is decoded: no frame holds that.
constexpr Channels Untouched = {4711};

struct FakeBoard {
  FakeSerial port;
  DecodeSBus sbus{port};

  explicit FakeBoard(size_t portCapacity = 64) : port(portCapacity) {}

  // Polls that find noise, then a pause: the loop period is known. What was counted until now is left out of
  // counted().
  void settle() {
    for (unsigned noise = 0; noise < 3; noise++) {
      wait(500);
      take({0x55});
    }
    wait(4 * Ms);
    _before = sbus.counters();
  }

  // `bytes` come in, back to back, then the sketch polls. Returns how many of them the port kept.
  size_t take(const Bytes &bytes) {
    wait(120 * bytes.size());
    const size_t kept = port.arrive(bytes);
    sbus.parseSBusFrame();
    return kept;
  }

  // Time goes on, and the sketch does nothing.
  void wait(uint64_t us) { fakeMicros += us; }

  // A frame comes in as the board hands it over: 16 bytes, and the others when the line has been idle for a character.
  static constexpr uint64_t FrameUs = 26 * 120;
  void frame(const Frame &frame) {
    take(part(frame, 0, 16));
    wait(120);
    take(part(frame, 16));
  }

  // And a pause before it, so that frames are 9 ms apart.
  void nextFrame(const Frame &next) {
    wait(9 * Ms - FrameUs);
    frame(next);
  }

  // The sketch asks for everything.
  Decoded decode() {
    Decoded decoded = {Untouched, false, false};
    sbus.decodeSBusFrame(decoded.channels.data(), decoded.failsafe, decoded.lostFrame);
    return decoded;
  }
  Channels channels() { return decode().channels; }

  sbus::Counters counted() const { return sbus.counters() - _before; }

 private:
  sbus::Counters _before = {};
};

// An open port whose loop period is known.
struct OpenBoard : FakeBoard {
  explicit OpenBoard(size_t portCapacity = 64) : FakeBoard(portCapacity) {
    sbus.begin();
    settle();
  }
};
