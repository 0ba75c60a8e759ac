// The receiver under whatever bytes, looks, times and breaks the fuzzer thinks of.
//
// The input: operations of one byte and what they need.
//   0xxxxxxx          a look behind the next so many hundreds of us, with the bytes that have come since
//   10xxxxxx          the next x + 1 bytes of the input come in
//   110xxxxx          a whole neutral frame comes in; x makes its CH1, and bit 4 its end byte 08
//   1110xxxx          2^x * 20 us pass
//   1111xxxx          the line breaks behind what was read (x = 0..13), reset (x = 14), a look without time (x = 15)
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "sbus/Receiver.h"

namespace {

void require(bool condition, const char *what) {
  if (!condition) {
    std::fprintf(stderr, "violated: %s\n", what);
    std::abort();
  }
}

class Line {
 public:
  Line() { reset(); }

  void reset() {
    _receiver.reset(_now, sbus::CharacterTime);
    startAnew();
    _frames = 0;
  }

  void arrive(uint8_t byte) {
    if (_waiting.size() < 64) {
      _waiting.push_back(byte);
    }
  }

  void pass(uint32_t us) { _now += us; }

  void broken() {
    _receiver.broken();
    startAnew();
  }

  void look() {
    size_t at = 0;
    size_t room;
    size_t count;
    unsigned calls = 0;
    do {
      room = static_cast<size_t>(_receiver.room());
      require(room >= 1 && room <= _roomAtStart, "room() is never 0, and never more than at the start");
      require(++calls <= 64 + 1, "every call but the last takes in a byte or more");
      count = _waiting.size() - at < room ? _waiting.size() - at : room;
      if (count != 0) {
        std::memcpy(_receiver.space(), _waiting.data() + at, count);
      }
      _fed.insert(_fed.end(), _waiting.begin() + static_cast<long>(at), _waiting.begin() + static_cast<long>(at + count));
      at += count;
      const size_t waiting = count == room ? _waiting.size() - at : 0;
      const bool complete = _receiver.received(static_cast<uint8_t>(count), static_cast<uint8_t>(waiting), _now);
      check(complete);
    } while (count == room);
    _waiting.clear();
  }

 private:
  void startAnew() {
    _fed.clear();
    _behindFrame = 0;
    _skippedAtStart = _receiver.counters().skippedBytes;
    _framesAtStart = _receiver.counters().frames;
    _roomAtStart = static_cast<uint32_t>(_receiver.room());
  }

  uint32_t heldBytes() const { return _roomAtStart - static_cast<uint32_t>(_receiver.room()); }

  void check(bool complete) {
    const sbus::Counters &counters = _receiver.counters();
    require(counters.frames == _frames + complete, "frames are counted one by one");
    _frames = counters.frames;
    const uint32_t frames = counters.frames - _framesAtStart;
    const uint32_t skipped = counters.skippedBytes - _skippedAtStart;
    require(_fed.size() == 25 * frames + skipped + heldBytes(), "bytes fed == 25 a frame + skipped + held");
    require(counters.lostFrames <= counters.frames && counters.failsafeFrames <= counters.frames, "flags <= frames");
    require((_receiver.frame() != nullptr) == (counters.frames != 0), "frame() is there from the first frame on");
    if (!complete) {
      return;
    }
    // Held are the newest bytes, and the frame stood right before them: contiguous, and behind the last break.
    const uint8_t *const frame = _receiver.frame();
    require(sbus::isFrame(frame), "a delivered frame is a frame");
    require(_fed.size() >= heldBytes() + 25, "a frame's bytes have come since the last break");
    const size_t begin = _fed.size() - heldBytes() - 25;
    require(begin >= _behindFrame, "frames do not overlap");
    require(std::memcmp(_fed.data() + begin, frame, 25) == 0, "a delivered frame stands in the line, byte for byte");
    _behindFrame = begin + 25;
  }

  sbus::Receiver _receiver;
  uint32_t _now = 0xFFFF0000;  // micros() wraps soon
  std::vector<uint8_t> _waiting;
  std::vector<uint8_t> _fed;  // since the last break
  size_t _behindFrame = 0;
  uint32_t _frames = 0;
  uint32_t _framesAtStart = 0;
  uint32_t _skippedAtStart = 0;
  uint32_t _roomAtStart = 0;
};

void neutralFrame(Line &line, unsigned variant) {
  uint16_t channels[18];
  for (uint16_t &channel : channels) {
    channel = 992;
  }
  channels[0] = static_cast<uint16_t>(900 + variant);
  channels[16] = 0;
  channels[17] = 0;
  uint8_t frame[25];
  sbus::pack(frame, channels, false, false);
  frame[24] = (variant & 16) != 0 ? 0x08 : 0x00;
  for (const uint8_t byte : frame) {
    line.arrive(byte);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  Line line;
  for (size_t at = 0; at < size; at++) {
    const uint8_t operation = data[at];
    if (operation < 0x80) {
      line.pass(operation * 100u);
      line.look();
    } else if (operation < 0xC0) {
      for (unsigned left = (operation & 0x3Fu) + 1; left > 0 && at + 1 < size; left--) {
        line.arrive(data[++at]);
      }
    } else if (operation < 0xE0) {
      neutralFrame(line, operation & 0x1F);
    } else if (operation < 0xF0) {
      line.pass(20u << (operation & 0xF));
    } else if (operation == 0xFE) {
      line.reset();
    } else if (operation == 0xFF) {
      line.look();
    } else {
      line.look();
      line.broken();
    }
  }
  line.look();
  return 0;
}
