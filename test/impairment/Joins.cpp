#include "Conditions.h"

#include <algorithm>
#include <functional>

#include <sbus/Frame.h>

#include "Runs.h"

namespace {

// (A port that hands over 8 bytes at once hides so much of a gap of 3.3 ms that a loop of 1 ms misses it now and then:
// one join of about 2000 delivers a frame that was never sent.)
bool gapsAreSeen(const Setup &setup) {
  return setup.callsBack() || (setup.periodUs >= (setup.loopUs <= 300 ? 6300 : 7000) && setup.loopUs <= 1000);
}

std::vector<Setup> all() {
  std::vector<Setup> setups =
      everyDriver({4000, 6300, 7000, 9000, 14000, 15000}, {50, 300, 1000, 2000, 3000, 4000, 5000});
  const std::vector<Setup> called = calledBack({4000, 6300, 7000, 9000, 14000, 15000});
  setups.insert(setups.end(), called.begin(), called.end());
  return setups;
}
std::vector<Setup> sbus2() { return everyDriver({15000}, {50, 300, 1000, 2000, 3000, 4000, 5000}); }
std::vector<Setup> seen() {
  std::vector<Setup> setups = all();
  setups.erase(std::remove_if(setups.begin(), setups.end(), std::not_fn(gapsAreSeen)), setups.end());
  return setups;
}
std::vector<Setup> hidden() {
  std::vector<Setup> setups = all();
  setups.erase(std::remove_if(setups.begin(), setups.end(), gapsAreSeen), setups.end());
  return setups;
}

// begin() while the line runs.
Run atBegin(bool inStep, Kind kind = Kind::Plain) {
  Run run;
  run.line.kind = kind;
  run.line.frames = FramesAfter + 1;
  run.joining = true;
  run.inStep = inStep;
  return run;
}
void pluggedIn(Run &run, Random &random) {
  run.silenceUs = random.chance(0.5) ? 5000 : 300000;
  run.line.cut.toCharacter = random.below(sbus::FrameSize);
  run.line.frames = FramesAfter + 1;
}
void unpluggedAtSameCharacter(Run &run, Random &random) {
  unplugged(run, random);
  run.line.cut.toCharacter = run.line.cut.fromCharacter;
}
// For longer than any frame period, and with no part of a frame before that: nothing but the silence tells it.
void unpluggedBetweenFrames(Run &run, Random &random) {
  Cut &cut = run.line.cut;
  cut.fromFrame = FramesInSync;
  cut.toFrame = FramesInSync + 1 + (60000 + random.below(400000)) / run.line.periodUs;
  cut.toCharacter = random.below(sbus::FrameSize);
  run.line.frames = cut.toFrame + 1 + FramesAfter;
}

}  // namespace

const std::vector<Condition> &joinLines() {
  static const std::vector<Payload> sticks = {Payload::ShiftedStill, Payload::Shifted, Payload::OtherEnd};
  constexpr Promise None = Promise::None;
  constexpr Promise NeverWrong = Promise::NeverWrong;
  static const auto join = [](const char *name, const Run &run, const std::vector<Setup> &setups, Promise promise,
                              void (*vary)(Run &, Random &) = nullptr) {
    return Condition{name, run, setups, promise, sticks, vary};
  };
  static const std::vector<Condition> lines = {
      join("joined: begin() while the line runs", atBegin(false), all(), NeverWrong),
      join("joined: plugged in after silence", Run(), all(), NeverWrong, pluggedIn),
      join("joined: unplugged, and again", Run(), seen(), NeverWrong, unplugged),
      join("joined: unplugged, and again, gaps not seen", Run(), hidden(), None, unplugged),
      join("joined: unplugged, and again at the same character", Run(), seen(), NeverWrong, unpluggedAtSameCharacter),
      join("joined: unplugged, and again at the same character, gaps not seen", Run(), hidden(), None,
           unpluggedAtSameCharacter),
      join("joined: unplugged between two frames, gaps not seen", Run(), hidden(), NeverWrong, unpluggedBetweenFrames),
      join("joined: loop in step", atBegin(true), all(), NeverWrong),
      join("joined: begin() while an S.BUS2 line runs", atBegin(false, Kind::Sbus2), sbus2(), NeverWrong),
  };
  return lines;
}
