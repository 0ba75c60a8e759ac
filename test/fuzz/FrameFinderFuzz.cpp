// Finds frames with any bytes, polls, times and breaks.
//
// The input: operations of one byte and what they need.
//   0xxxxxxx          a poll after this many hundreds of us, with the bytes that have come since, if any
//   10xxxxxx          the next x + 1 bytes of the input come in
//   110xxxxx          a whole neutral frame comes in; x sets its CH1, and bit 4 its end byte 08; x = 14: a frame with
//                     header 2F; x = 15: a frame of 36 bytes
//   1110xxxx          2^x * 20 us pass
//   1111xxxx          the line breaks after what was read (x = 0..12), reset (x = 13 and 14), a poll without time (x =
//   15)
//
// Each input is taken five times for each frame size: polled, by events, by a port that tells when its line was idle,
// as the Grasshopper's; by calls in any order, each of which a byte after its operation chooses (Any); and so by a
// clock that jumps (x = 8..12) and stops, and a port that loses bytes that wait.
#include <algorithm>
#include <cstring>
#include <vector>

#include "fuzz/Require.h"
#include "sbus/ExtraFrame.h"
#include "sbus/FrameFinder.h"
#include "support/Bytes.h"
#include "support/KnownFrames.h"

namespace {

enum class Calls { Polled, ByEvents, Idling, Any, Unsteady };

template <typename Format, typename Events>
class Sketch {
 public:
  explicit Sketch(Calls calls) : _calls(calls) { reset(); }

  void reset() {
    _finder.reset(_now, sbus::CharacterTime, hasIdle() ? 1 : sbus::IdleCharactersMax);
    startAnew();
    _frames = 0;
    _call = _now;
    std::fill(_waitingNotBy.begin(), _waitingNotBy.end(), _now);  // of what waits now, no time is known
  }

  bool isAny() const { return _calls == Calls::Any || _calls == Calls::Unsteady; }
  bool isUnsteady() const { return _calls == Calls::Unsteady; }

  void arrive(uint8_t byte) {
    _ring++;
    if (_waiting.size() < 64) {
      _waiting.push_back(byte);
      _waitingNotBy.push_back(_call);
    }
  }

  // Takes bytes from the port, as a sketch must not.
  void lose(size_t count) {
    _waiting.resize(_waiting.size() - std::min(count, _waiting.size()));
    _waitingNotBy.resize(_waiting.size());
  }

  void pass(uint32_t us) { _now += us; }

  void broken() {
    _finder.bytesLost();
    startAnew();
  }

  // `choice`: which calls, where any may be made.
  void poll(unsigned choice) {
    if (_waiting.empty() && _calls == Calls::ByEvents) {
      return;
    }
    _call = _now;
    if (_waiting.empty()) {
      check(_finder.idle(_now));
      return;
    }
    const unsigned found = static_cast<unsigned>(_waiting.size());
    const bool isIdle = isAny() ? (choice & 1) != 0 : _ring % 16 != 0;
    const bool fromCallback = !isAny() || (choice & 2) != 0;
    const bool mayWait = isAny() ? (choice & 4) != 0 : hasIdle() && !isIdle;
    if (mayWait && _finder.mayWait(found, _now)) {
      check(nullptr);
      return;
    }
    if (hasIdle()) {
      _finder.pollIdling(found, _now, fromCallback, isIdle);
    } else {
      _finder.poll(found, _now);
    }
    for (size_t at = 0; at < _waiting.size();) {
      const size_t room = static_cast<size_t>(_finder.room());
      require(room >= 1 && room <= _roomAtStart, "room() is never 0, and never more than at the start");
      const size_t count = std::min(_waiting.size() - at, room);
      const uint8_t *const bytes = _waiting.data() + at;
      std::memcpy(_finder.space(), bytes, count);
      _fed.insert(_fed.end(), bytes, bytes + count);
      _notBy.insert(_notBy.end(), _waitingNotBy.data() + at, _waitingNotBy.data() + at + count);
      at += count;
      check(_finder.received(static_cast<int>(count), static_cast<int>(_waiting.size() - at)));
    }
    _waiting.clear();
    _waitingNotBy.clear();
    if (isAny() ? (choice & 16) != 0 : hasIdle() && isIdle) {
      check(_finder.ended());
      if ((choice & 32) != 0) {
        check(_finder.ended());
      }
    }
  }

 private:
  void startAnew() {
    _fed.clear();
    _notBy.clear();
    _afterFrame = 0;
    _discardedAtStart = _finder.counters().discardedBytes;
    _framesAtStart = _finder.counters().frames;
    _extrasAtStart = _finder.counters().extraFrames;
    _roomAtStart = static_cast<uint32_t>(_finder.room());
  }

  uint32_t heldBytes() const { return _roomAtStart - static_cast<uint32_t>(_finder.room()); }

  void check(const uint8_t *delivered) {
    const bool complete = delivered != nullptr;
    const sbus::Counters &counters = _finder.counters();
    require(counters.frames == _frames + complete, "frames are counted one by one");
    _frames = counters.frames;
    const uint32_t frames = counters.frames - _framesAtStart;
    const uint32_t skipped = counters.discardedBytes - _discardedAtStart;
    const uint32_t extras = counters.extraFrames - _extrasAtStart;
    require(_fed.size() == Size * frames + 25 * extras + skipped + heldBytes(),
            "bytes fed == those of all frames + skipped + held");
    require((_finder.frame() != nullptr) == (counters.frames != 0), "frame() is there from the first frame on");
    if (!complete) {
      return;
    }
    // The finder holds the newest bytes, and the frame was right before them: contiguous, and after the last break.
    const uint8_t *const frame = _finder.frame();
    require(delivered == frame, "received() and idle() return frame()");
    require(reinterpret_cast<uintptr_t>(frame + sbus::PayloadIndex) % 4 == 0, "a payload stands at a multiple of four");
    require(frame[0] == 0x0F && sbus::isFlagsByte(frame[Size - 2]), "a delivered frame is a frame");
    require(Size == 36 ? frame[Size - 1] == 0 : sbus::isEndByte(frame[Size - 1]), "a delivered frame ends as one");
    require(_fed.size() >= heldBytes() + Size, "a frame's bytes have come since the last break");
    const size_t begin = _fed.size() - heldBytes() - Size;
    require(begin >= _afterFrame, "frames do not overlap");
    require(std::memcmp(_fed.data() + begin, frame, Size) == 0, "a delivered frame stands in the line, byte for byte");
    const uint32_t notBy = _notBy[begin + Size - 1];
    require(isUnsteady() || static_cast<int32_t>(notBy - 4 * sbus::CharacterTime - _finder.frameTime()) >= 0,
            "no frame is too young");
    _afterFrame = begin + Size;
  }

  static constexpr uint32_t Size = Format::Size;

  bool hasIdle() const { return _calls >= Calls::Idling; }

  const Calls _calls;
  sbus::FrameFinderOf<Format, Events> _finder;
  uint32_t _now = 0xFFFF0000;  // micros() wraps soon
  uint32_t _call = 0;          // the time of the newest call
  unsigned _ring = 0;          // bytes that have come
  std::vector<uint8_t> _waiting;
  std::vector<uint32_t> _waitingNotBy;  // for each, the time of the last call that did not find it
  std::vector<uint8_t> _fed;            // since the last break
  std::vector<uint32_t> _notBy;         // likewise
  size_t _afterFrame = 0;
  uint32_t _frames = 0;
  uint32_t _framesAtStart = 0;
  uint32_t _extrasAtStart = 0;
  uint32_t _discardedAtStart = 0;
  uint32_t _roomAtStart = 0;
};

template <typename Format, typename Events = sbus::NoEvents>
void run(const uint8_t *data, size_t size, Calls calls) {
  Sketch<Format, Events> sketch(calls);
  size_t at = 0;
  const auto poll = [&] { sketch.poll(sketch.isAny() && at + 1 < size ? data[++at] : 0); };
  for (; at < size; at++) {
    const uint8_t operation = data[at];
    if (operation < 0x80) {
      sketch.pass(operation * 100u);
      poll();
    } else if (operation < 0xC0) {
      for (unsigned left = (operation & 0x3Fu) + 1; left > 0 && at + 1 < size; left--) {
        sketch.arrive(data[++at]);
      }
    } else if (operation == 0xCE || operation == 0xCF) {
      for (const uint8_t byte : operation == 0xCE ? bytesOf(extraFrame(1)) : bytesOf(longFrame(1, true))) {
        sketch.arrive(byte);
      }
    } else if (operation < 0xE0) {
      for (const uint8_t byte : neutralFrame(operation & 0x1F, (operation & 0x10) != 0 ? R7003End : 0x00)) {
        sketch.arrive(byte);
      }
    } else if (operation < 0xF0) {
      sketch.pass(20u << (operation & 0xF));
    } else if (operation == 0xFD || operation == 0xFE) {
      sketch.reset();
    } else if (operation == 0xFF) {
      poll();
    } else if (sketch.isUnsteady() && operation >= 0xF8) {
      constexpr uint32_t Jumps[] = {1000000, 1u << 30, 1u << 31, 0u - 1000, 0u - 1000000};  // us
      sketch.pass(Jumps[operation - 0xF8]);
    } else if (sketch.isUnsteady() && operation >= 0xF4) {
      sketch.lose(operation - 0xF3u);
    } else {
      poll();
      sketch.broken();
    }
  }
  poll();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  for (const Calls calls : {Calls::Polled, Calls::ByEvents, Calls::Idling, Calls::Any, Calls::Unsteady}) {
    run<sbus::Frame16>(data, size, calls);
    run<sbus::Frame16Extra, sbus::ExtraFrame>(data, size, calls);
    run<sbus::Frame24>(data, size, calls);
  }
  return 0;
}
