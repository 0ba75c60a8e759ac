// The decoders that the simulated sketch uses.
#pragma once

#include <algorithm>
#include <cstdint>

#include "support/UartPort.h"

#include "support/BitByBit.h"
#include "support/PaperDecoder.h"

#include <DecodeSBus32.h>

// newFrame(): since the last call, and so newExtra(). Judged are the frames, not the link: failsafe is
// then the frame's own, and one that waited while loop() was blocked for longer than the timeout is still read.
template <typename Decoder, typename Format, unsigned Mask>
class OursOf {
 public:
  static constexpr unsigned Size = Format::Size, FlagsMask = Mask;
  static constexpr bool PollsInLoop = true;

  template <typename Port>
  explicit OursOf(Port &port) : _sbus(port) {
    _sbus.setLossLimit(0);
    _sbus.setTimeout(0);
  }
  void begin(unsigned long baud) { _sbus.begin(baud); }
  void parse() { _sbus.parseSBusFrame(); }
  bool newFrame(LongFrame &frame) {
    if (!_sbus.newFrame()) {
      return false;
    }
    LongChannels channels{};
    bool failsafe = false;
    bool lostFrame = false;
    _sbus.decodeSBusFrame(channels.data(), failsafe, lostFrame);
    Format::pack(frame.data(), channels.data(), failsafe, lostFrame);
    return true;
  }
  bool newExtra(LongFrame &) { return false; }
  // Returns an age that the newest frame has not reached, by its age in full ms.
  uint64_t youngerThanUs() { return (uint64_t{_sbus.frameAge()} + 1) * 1000; }
  uint32_t breaks() const { return _sbus.counters().overflows + _sbus.counters().shortfalls; }

 protected:
  Decoder _sbus;
};

using Ours = OursOf<DecodeSBus, sbus::Frame16, 0x0F>;
using Ours24 = OursOf<DecodeSBus24, sbus::Frame24, 0x0C>;

class Ours32 : public OursOf<DecodeSBus32, sbus::Frame16Extra, 0x0F> {
 public:
  using OursOf::OursOf;
  bool newExtra(LongFrame &frame) {
    const uint32_t count = _sbus.counters().extraFrames;
    Channels channels{};
    if (count == _extras || !_sbus.decodeExtraChannels(channels.data())) {
      return false;
    }
    _extras = count;
    sbus::pack(frame.data(), channels.data(), false, false);
    return true;
  }

 private:
  uint32_t _extras = 0;
};

class Papers {
 public:
  static constexpr unsigned Size = sbus::FrameSize, FlagsMask = 0x0F;
  static constexpr bool PollsInLoop = false;

  explicit Papers(HardwareSerial &port) : _paper(port) {}
  void begin(unsigned long baud) { _paper.begin(baud); }
  void parse() { _paper.parseSBusFrame(); }
  bool newFrame(LongFrame &frame) {
    if (_paper.frames() == _seen) {
      return false;
    }
    _seen = _paper.frames();
    std::copy_n(_paper.frame(), Size, frame.begin());
    return true;
  }
  bool newExtra(LongFrame &) { return false; }
  uint64_t youngerThanUs() { return fakeMicros; }
  uint32_t breaks() const { return 0; }

 private:
  PaperDecoder _paper;
  uint32_t _seen = 0;
};
