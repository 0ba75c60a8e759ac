// Notes periods of failsafe, lost frames and silence, and late reads by the PC, for `sbus summary` and its report.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "line/Silence.h"

namespace line {

struct FlagSpan {
  enum class Kind { Failsafe, NoPulses, LostFrame, NoFrames, Late, Jump };  // Jump: line::Jumps

  Kind kind;
  uint64_t fromUs;
  uint64_t toUs;
  uint32_t channels = 0;  // that have jumped, bit 0 for CH1

  uint64_t us() const { return toUs - fromUs; }
};

// The kinds, as a text and JSON name them, and by their colour in a report.
struct SpanName {
  FlagSpan::Kind kind;
  const char *name, *type, *colour;
};
constexpr SpanName SpanNames[] = {{FlagSpan::Kind::Failsafe, "failsafe", "failsafe", "failsafe"},
                                  {FlagSpan::Kind::NoPulses, "no pulses", "no_pulses", "failsafe"},
                                  {FlagSpan::Kind::LostFrame, "lost frames", "lost_frames", "lost"},
                                  {FlagSpan::Kind::NoFrames, "no frames", "no_frames", "silent"},
                                  {FlagSpan::Kind::Late, "PC late", "late", "late"},
                                  {FlagSpan::Kind::Jump, "jumps", "jump", "lost"}};

// Returns their total length.
inline uint64_t sumUs(const std::vector<FlagSpan> &spans) {
  uint64_t us = 0;
  for (const FlagSpan &span : spans) {
    us += span.us();
  }
  return us;
}

// Returns the numbers of the channels that have jumped.
inline std::vector<unsigned> jumped(const FlagSpan &span) {
  std::vector<unsigned> numbers;
  for (unsigned i = 0; i < 32; i++) {
    if ((span.channels >> i & 1) != 0) {
      numbers.push_back(i + 1);
    }
  }
  return numbers;
}

// Returns "CH4, CH7", the channels that have jumped; otherwise "".
inline std::string jumpedText(const FlagSpan &span) {
  std::string text;
  for (const unsigned number : jumped(span)) {
    text += (text.empty() ? "CH" : ", CH") + std::to_string(number);
  }
  return text;
}

// Returns the `count` longest ones, longest first.
inline std::vector<FlagSpan> longest(std::vector<FlagSpan> spans, size_t count) {
  std::stable_sort(spans.begin(), spans.end(), [](const FlagSpan &a, const FlagSpan &b) { return a.us() > b.us(); });
  spans.resize(std::min(spans.size(), count));
  return spans;
}

// A flag's span lasts from the first frame with the flag to the next one without, to a silence, to a late read by the
// PC, or to the end. A frame with both flags counts as failsafe only. Frames without pulses have no flag: Values.
// What comes before the first frame and after the last one is a span like others.
class FlagSpans {
 public:
  // Takes when the line begins, before its first frame. Without it, the line begins with that frame.
  void begin(uint64_t us) { _fromUs = us; }

  // Returns true if the line was silent between the newest frame, or its beginning, and the next frame, at `us`, or if
  // the PC was late, according to that frame's `lateUs`. All spans end there.
  bool brokenUntil(uint64_t us, uint32_t lateUs) {
    const uint64_t sinceUs = _lastUs > 0 ? _lastUs : std::min(us, _fromUs);
    const Gap gap = gapOf(sinceUs, us, lateUs);
    if (gap == Gap::Ordinary) {
      return false;
    }
    endFlags();
    _all.push_back({gap == Gap::Late ? FlagSpan::Kind::Late : FlagSpan::Kind::NoFrames, sinceUs, us});
    return true;
  }

  // Takes a jump of these channels in the newest frame; the next one is at `us`.
  void jump(uint64_t us, uint32_t channels) { _all.push_back({FlagSpan::Kind::Jump, _lastUs, us, channels}); }

  // Takes the flags of the next frame.
  void put(uint64_t us, bool failsafe, bool lostFrame, bool noPulses) {
    _firstUs = _lastUs == 0 ? us : _firstUs;
    _lastUs = us;
    set(_failsafe, failsafe);
    set(_noPulses, noPulses);
    set(_lostFrame, lostFrame && !failsafe);
  }

  // Ends all spans. Call it after the last frame. The line ends at `us`, or with that frame.
  void finish(uint64_t us) {
    if (_lastUs > 0) {
      brokenUntil(std::max(us, _lastUs), 0);
    }
    endFlags();
  }

  // Returns the spans in the order in which they ended.
  const std::vector<FlagSpan> &all() const { return _all; }

  // Return the times of the first and the newest frame; 0 before the first.
  uint64_t firstUs() const { return _firstUs; }
  uint64_t lastUs() const { return _lastUs; }

 private:
  void endFlags() {
    set(_failsafe, false);
    set(_noPulses, false);
    set(_lostFrame, false);
  }

  struct Flag {
    FlagSpan::Kind kind;
    bool is;
    uint64_t fromUs;
  };

  void set(Flag &flag, bool is) {
    if (is && !flag.is) {
      flag.fromUs = _lastUs;
    } else if (!is && flag.is) {
      _all.push_back({flag.kind, flag.fromUs, _lastUs});
    }
    flag.is = is;
  }

  Flag _failsafe = {FlagSpan::Kind::Failsafe, false, 0};
  Flag _noPulses = {FlagSpan::Kind::NoPulses, false, 0};
  Flag _lostFrame = {FlagSpan::Kind::LostFrame, false, 0};
  std::vector<FlagSpan> _all;
  uint64_t _fromUs = UINT64_MAX;  // the line's beginning
  uint64_t _firstUs = 0;
  uint64_t _lastUs = 0;
};

}  // namespace line
