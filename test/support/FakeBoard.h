// A DecodeSBus, DecodeSBus24 or DecodeSBus32 on a FakeSerial, and what a sketch does with them.
#pragma once

#include "Bytes.h"
#include "FakeClock.h"
#include "FakeSerial.h"
#include "KnownFrames.h"

#include <DecodeSBus32.h>

constexpr uint64_t Ms = 1000;  // us

// The value of a sketch's channels before a frame is decoded; no frame has it.
constexpr Channels Untouched = {4711};
constexpr LongChannels UntouchedLong = {4711};

// `Decoder` is DecodeSBus, DecodeSBus24 or DecodeSBus32.
template <typename Decoder, typename Format>
struct FakeBoardOf {
  using Frame = std::array<uint8_t, Format::Size>;
  using Channels = std::array<uint16_t, Format::Channels>;
  struct Decoded {
    Channels channels;
    bool failsafe;
    bool lostFrame;
  };

  FakeSerial port;
  Decoder sbus{port};

  explicit FakeBoardOf(size_t portCapacity = 64) : port(portCapacity) {}

  // Lets time pass while loop() is blocked.
  void block(uint64_t us) { fakeMicros += us; }

  // Lets time pass; then the sketch polls, and finds nothing.
  void wait(uint64_t us) {
    block(us);
    sbus.parseSBusFrame();
  }

  // Hands `bytes` over, and polls. Returns how many of them the port kept.
  size_t poll(const Bytes &bytes) {
    const size_t kept = port.arrive(bytes);
    sbus.parseSBusFrame();
    return kept;
  }

  // Hands them over after the time that they take back to back, while loop() is blocked.
  size_t take(const Bytes &bytes) {
    block(120 * bytes.size());
    return poll(bytes);
  }

  // Receives a frame as the board hands it over: 16 bytes at a time, the last ones when the line has been idle for a
  // character. loop() is quick, and polls just before.
  static constexpr uint64_t FrameUs = (Format::Size + 1) * 120;
  void frame(const Frame &frame) {
    constexpr size_t Burst = 16;
    for (size_t at = 0; at < frame.size(); at += Burst) {
      const Bytes burst = part(frame, at, at + Burst);
      wait((burst.size() < Burst ? burst.size() + 1 : Burst) * 120);
      poll(burst);
    }
  }

  // Receives a frame after a gap, so that frames are 9 ms apart.
  void nextFrame(const Frame &next) {
    wait(9 * Ms - FrameUs);
    frame(next);
  }

  // Receives a frame, and the shortest silence after it that proves the first one.
  static constexpr uint64_t SilenceUs = Format::SpreadMax * 120 + 1;
  void firstFrame(const Frame &first) {
    frame(first);
    wait(SilenceUs);
  }

  // Calls every method that a sketch reads.
  Decoded decode() {
    Decoded decoded = {{4711}, false, false};
    sbus.decodeSBusFrame(decoded.channels.data(), decoded.failsafe, decoded.lostFrame);
    return decoded;
  }
  Channels channels() { return decode().channels; }
};

using FakeBoard = FakeBoardOf<DecodeSBus, sbus::Frame16>;
using FakeBoard32 = FakeBoardOf<DecodeSBus32, sbus::Frame16Extra>;
using Decoded = FakeBoard::Decoded;

// An open port.
struct OpenBoard : FakeBoard {
  explicit OpenBoard(size_t portCapacity = 64) : FakeBoard(portCapacity) { sbus.begin(); }
};

// In sync with a line: a frame has come.
struct SyncedBoard : OpenBoard {
  explicit SyncedBoard(size_t portCapacity = 64) : OpenBoard(portCapacity) {
    firstFrame(Neutral.bytes);
    _before = sbus.counters();
  }

  // Since then.
  sbus::Counters counted() const { return sbus.counters() - _before; }

 private:
  sbus::Counters _before;
};
