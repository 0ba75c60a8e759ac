// A DecodeSBus on a FakeSerial, and what a sketch does with them. To be included last: Arduino.h's macros min and max
// break the standard headers behind them.
#pragma once

#include <initializer_list>

#include "BitByBit.h"
#include "FakeClock.h"
#include "FakeSerial.h"

#include <DecodeSBus.h>

using Bytes = std::vector<uint8_t>;

inline Bytes bytesOf(std::initializer_list<Frame> frames) {
  Bytes bytes;
  for (const Frame &frame : frames) {
    bytes.insert(bytes.end(), frame.begin(), frame.end());
  }
  return bytes;
}

inline Bytes part(const Frame &frame, unsigned from, unsigned to = 25) {
  return Bytes(frame.begin() + from, frame.begin() + to);
}

inline Bytes operator+(Bytes left, const Bytes &right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

struct Decoded {
  Channels channels;
  bool failsafe;
  bool lostFrame;
};

struct FakeBoard {
  FakeSerial port;
  DecodeSBus sbus{port};

  explicit FakeBoard(size_t portCapacity = 64) : port(portCapacity) {}

  // `bytes` come in, then the sketch looks. Returns how many of them the port kept.
  size_t take(const Bytes &bytes) {
    const size_t kept = port.arrive(bytes);
    sbus.parseSBusFrame();
    return kept;
  }

  // Time goes on, and the sketch does nothing.
  void wait(uint64_t us) { fakeMicros += us; }

  // A frame comes in, back to back, and the sketch looks when it is there.
  void frame(const Frame &frame) {
    wait(25 * 120);
    take(bytesOf({frame}));
  }

  // The sketch asks for everything; `before` is what its channels hold until then.
  Decoded decode(const Channels &before = Channels{}) {
    Decoded decoded = {before, false, false};
    sbus.decodeSBusFrame(decoded.channels.data(), decoded.failsafe, decoded.lostFrame);
    return decoded;
  }
  Channels channels() { return decode().channels; }
};

struct OpenBoard : FakeBoard {
  explicit OpenBoard(size_t portCapacity = 64) : FakeBoard(portCapacity) { sbus.begin(); }
};
