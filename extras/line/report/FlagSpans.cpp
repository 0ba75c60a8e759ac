#include "line/report/FlagSpans.h"

#include <algorithm>

#include "line/Silence.h"

namespace line {

uint64_t sumUs(const std::vector<FlagSpan> &spans) {
  uint64_t us = 0;
  for (const FlagSpan &span : spans) {
    us += span.us();
  }
  return us;
}

std::vector<FlagSpan> longest(std::vector<FlagSpan> spans, size_t count) {
  std::stable_sort(spans.begin(), spans.end(), [](const FlagSpan &a, const FlagSpan &b) { return a.us() > b.us(); });
  spans.resize(std::min(spans.size(), count));
  return spans;
}

bool FlagSpans::brokenUntil(uint64_t us, uint32_t lateUs) {
  const Gap gap = _lastUs == 0 ? Gap::Ordinary : gapOf(_lastUs, us, lateUs);
  if (gap == Gap::Ordinary) {
    return false;
  }
  finish();
  _all.push_back({gap == Gap::Late ? FlagSpan::Kind::Late : FlagSpan::Kind::NoFrames, _lastUs, us});
  return true;
}

void FlagSpans::put(uint64_t us, bool failsafe, bool lostFrame, bool noPulses) {
  _firstUs = _lastUs == 0 ? us : _firstUs;
  _lastUs = us;
  set(_failsafe, failsafe);
  set(_noPulses, noPulses);
  set(_lostFrame, lostFrame && !failsafe);
}

void FlagSpans::finish() {
  set(_failsafe, false);
  set(_noPulses, false);
  set(_lostFrame, false);
}

void FlagSpans::set(Flag &flag, bool is) {
  if (is && !flag.is) {
    flag.fromUs = _lastUs;
  } else if (!is && flag.is) {
    _all.push_back({flag.kind, flag.fromUs, _lastUs});
  }
  flag.is = is;
}

}  // namespace line
