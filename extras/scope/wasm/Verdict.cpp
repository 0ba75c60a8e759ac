// What is wrong with the line, in the words of sbus/Diagnosis.
#include "ShownLine.h"

using namespace scope;

namespace {

sbus::Diagnosis trials;

}  // namespace

// Begins a round: each setting of the port is tried once, the expected one first.
EXPORT(beginRound)()->void { trials.begin(); }

// Takes what came since the port was opened with its present setting.
EXPORT(addTrial)()->void {
  trials.add(shownLine.examination.trial(shownLine.observer, shownLine.settings, shownLine.nowUs()));
}

EXPORT(roundFinding)()->int { return static_cast<int>(trials.finding()); }
EXPORT(roundBest)()->int { return trials.best(); }

// Forgets what has come before.
EXPORT(mark)()->void { shownLine.mark(); }

EXPORT(findingText)(int finding)->const char * { return sbus::text(static_cast<sbus::Finding>(finding)); }
EXPORT(findingRemedy)(int finding)->const char * { return sbus::remedy(static_cast<sbus::Finding>(finding)); }
EXPORT(findingIsWell)(int finding)->int { return line::isWell(static_cast<sbus::Finding>(finding)); }
