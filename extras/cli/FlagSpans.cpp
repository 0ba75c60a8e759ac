#include "cli/FlagSpans.h"

#include "sbus/Link.h"

namespace tool {

namespace {

constexpr uint64_t SilenceUs = sbus::Link::DefaultTimeout * 1000;

}  // namespace

bool FlagSpans::silentUntil(uint64_t us) {
  if (_lastUs == 0 || us - _lastUs <= SilenceUs) {
    return false;
  }
  finish();
  _all.push_back({FlagSpan::Kind::NoFrames, _lastUs, us});
  return true;
}

void FlagSpans::put(uint64_t us, bool failsafe, bool lostFrame) {
  _firstUs = _lastUs == 0 ? us : _firstUs;
  _lastUs = us;
  set(_failsafe, failsafe);
  set(_lostFrame, lostFrame && !failsafe);
}

void FlagSpans::finish() {
  set(_failsafe, false);
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

}  // namespace tool
