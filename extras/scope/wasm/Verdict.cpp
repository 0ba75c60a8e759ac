// What is wrong with the line, in the words of sbus/Diagnosis.
#include "Scope.h"
#include "sbus/Diagnosis.h"

using namespace scope;

namespace {

sbus::Diagnosis trials;

// A character that a port has dropped is a byte of no frame, too.
sbus::Counters seen() {
  sbus::Counters counters = theScope.observer.counters();
  counters.discardedBytes += static_cast<uint32_t>(theScope.observer.badCharacters());
  return counters;
}

sbus::Counters since(const sbus::Counters &before, const sbus::Counters &now) {
  sbus::Counters counters = now;
  counters.frames -= before.frames;
  counters.lostFrames -= before.lostFrames;
  counters.failsafeFrames -= before.failsafeFrames;
  counters.rejectedByEnd -= before.rejectedByEnd;
  counters.rejectedByFlags -= before.rejectedByFlags;
  counters.rejectedByLength -= before.rejectedByLength;
  counters.discardedBytes -= before.discardedBytes;
  counters.resyncs -= before.resyncs;
  counters.overflows -= before.overflows;
  counters.extraFrames -= before.extraFrames;
  counters.otherSizeFrames -= before.otherSizeFrames;
  return counters;
}

sbus::Counters atMark;

}  // namespace

// A round begins: every setting of the port is tried once, the one that is meant first.
EXPORT(beginRound)()->void {
  trials.begin();
}

// What came since the port was opened, `ms` ago, with this setting.
EXPORT(addTrial)(double baud, int inverted, unsigned ms)->void {
  trials.add({static_cast<unsigned long>(baud), inverted != 0, ms, seen()});
}

EXPORT(roundFinding)()->int {
  return static_cast<int>(trials.finding());
}
EXPORT(roundBest)()->int {
  return trials.best();
}

// From here on verdict() counts.
EXPORT(mark)()->void {
  atMark = seen();
}

// Of the setting as it is, and what came since mark(), `ms` ago.
EXPORT(verdict)(unsigned ms)->int {
  sbus::Diagnosis diagnosis;
  diagnosis.add({sbus::Baud, true, ms, since(atMark, seen())});
  return static_cast<int>(diagnosis.finding());
}

EXPORT(findingText)(int finding)->const char * {
  return sbus::text(static_cast<sbus::Finding>(finding));
}
EXPORT(findingCure)(int finding)->const char * {
  return sbus::cure(static_cast<sbus::Finding>(finding));
}
