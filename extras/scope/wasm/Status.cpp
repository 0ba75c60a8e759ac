// What the page says of the line as a whole.
#include "Scope.h"

using namespace scope;

namespace {

// src/core.ts has the names in this order.
struct Status {
  double state, ageUs, framesPerSecond, gapMinUs, gapMeanUs, gapMaxUs, characters, badCharacters, frames, lostFrames,
      failsafeFrames, rejectedByEnd, rejectedByFlags, rejectedByLength, discardedBytes, resyncs, overflows, extraFrames, rows,
      otherLines, garbled;
};
Status answer;

double marks[2];

}  // namespace

EXPORT(status)(double now)->const Status * {
  const auto nowUs = static_cast<uint64_t>(now);
  line::Observer &observer = theScope.observer;
  const sbus::Counters &counters = observer.counters();
  BoardRows &rows = theScope.rows;
  const bool text = rows.recognised();
  const line::Extent &gaps = text ? rows.gaps() : observer.gaps();
  const auto d = [](uint64_t value) { return static_cast<double>(value); };
  answer = {d(static_cast<uint64_t>(text ? rows.state(nowUs) : observer.state(nowUs))),
            d(text ? rows.ageUs(nowUs) : observer.ageUs(nowUs)),
            d(text ? rows.perSecond(nowUs) : observer.perSecond(nowUs)),
            d(gaps.low),
            d(gaps.mean()),
            d(gaps.high),
            d(observer.characters()),
            d(observer.badCharacters()),
            d(counters.frames),
            d(counters.lostFrames),
            d(counters.failsafeFrames),
            d(counters.rejectedByEnd),
            d(counters.rejectedByFlags),
            d(counters.rejectedByLength),
            d(counters.discardedBytes),
            d(counters.resyncs),
            d(counters.overflows),
            d(counters.extraFrames),
            d(rows.count()),
            d(rows.otherLines()),
            d(rows.garbled())};
  return &answer;
}

// Least and most of a channel, from 0 on; nullptr if there is none yet.
EXPORT(travel)(unsigned channel)->const double * {
  if (theScope.rows.recognised()) {
    const BoardRows::Travel *const travel = theScope.rows.travel(channel);
    marks[0] = travel != nullptr ? travel->low : 0;
    marks[1] = travel != nullptr ? travel->high : 0;
    return travel != nullptr ? marks : nullptr;
  }
  const line::Extent &travel = theScope.observer.travel(channel);
  marks[0] = static_cast<double>(travel.low);
  marks[1] = static_cast<double>(travel.high);
  return travel.count > 0 ? marks : nullptr;
}

EXPORT(resetMarks)()->void {
  theScope.observer.resetMarks();
  theScope.rows.resetMarks();
}
