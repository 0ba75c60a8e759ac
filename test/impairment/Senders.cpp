#include "Conditions.h"

#include <algorithm>

#include "Runs.h"

namespace {

constexpr Promise None = Promise::None;
constexpr Promise NeverWrong = Promise::NeverWrong;

const std::vector<Setup> &polled() {
  static const std::vector<Setup> list = [] {
    std::vector<Setup> setups = everyDriver({9000, 14000}, {50, 300, 1000, 3000});
    for (const uint32_t periodUs : {9000u, 14000u}) {
      for (const uint32_t loopUs : {50u, 300u, 1000u, 3000u}) {
        setups.push_back({periodUs, loopUs, Avr, 256});
      }
    }
    return setups;
  }();
  return list;
}
// Other interrupts hold a call up, and the way to it takes time.
const std::vector<Setup> &called() {
  static const std::vector<Setup> list = calledBack({9000, 14000}, 40);
  return list;
}
// A poll sees each gap between frames, 3.1 ms at the least, and that no silence within a frame is as long. (At 9 ms a
// port that holds back more hides too much of a gap.)
bool gapsAreSeen(const Setup &setup) {
  const bool holdsBack = setup.driver.idleCharacters > 2 || setup.driver.burst > 16;
  return setup.loopUs <= 300 && (setup.periodUs >= 14000 || !holdsBack);
}
std::vector<Setup> chosen(bool areGapsSeen) {
  std::vector<Setup> setups = polled();
  setups.erase(std::remove_if(setups.begin(), setups.end(),
                              [areGapsSeen](const Setup &setup) { return gapsAreSeen(setup) != areGapsSeen; }),
               setups.end());
  return setups;
}
const std::vector<Setup> &seen() {
  static const std::vector<Setup> list = chosen(true);
  return list;
}
const std::vector<Setup> &hidden() {
  static const std::vector<Setup> list = chosen(false);
  return list;
}
// An AVR: each character has its time.
const std::vector<Setup> &byCharacter() {
  static const std::vector<Setup> list = {{9000, 50, Avr, 256}, {14000, 50, Avr, 256}};
  return list;
}

// An eLeReS receiver sends a frame in 3 to 6 ms (iNavFlight/inav, pull request 2718), a Mikado VBasic in 4 ms
// (rotorflight/rotorflight-firmware, issue 216).
Run every(uint32_t us) {
  Run run;
  run.line.spreadUs = us - run.line.characterUs();
  return run;
}
Run atRandom() {
  Run run;
  run.line.jitterUs = 120;
  return run;
}
// "New RC receivers with gaps in SBUS frames" (ArduPilot/ardupilot, pull request 19899). For Betaflight a frame ends
// only at more than 600 us between two characters (betaflight/betaflight, pull request 15388).
Run interrupted(unsigned count) {
  Run run;
  run.line.silences.count = count;
  return run;
}
Run interruptedFor(uint32_t us, unsigned count) {
  Run run = interrupted(count);
  run.line.silences.leastUs = run.line.silences.mostUs = us;
  return run;
}
Run interruptedAfter(unsigned characters, uint32_t us) {
  Run run = interruptedFor(us, 1);
  run.line.silences.after = characters;
  return run;
}
void interruptedElsewhere(Run &run, Random &random) {
  run.line.silences.count = 1 + random.below(3);
  run.line.silences.eachFrame = true;
}
// Any of them.
void inexact(Run &run, Random &random) {
  const uint32_t kind = random.below(4);
  if (kind == 0) {
    run.line.spreadUs = 45 + random.below(76);
  } else if (kind == 1) {
    run.line.jitterUs = 120;
  } else {
    interruptedElsewhere(run, random);
    run.line.silences.eachFrame = kind == 3;
  }
}
void inexactAndUnplugged(Run &run, Random &random) {
  inexact(run, random);
  unplugged(run, random);
}

// ArduPilot's own sender at 200 Hz (ArduPilot/ardupilot, pull request 6794: "jitter to +/-750usec").
Run unsteady(Run run = plain()) {
  run.line.unsteadyUs = 750;
  return run;
}

Run noiseBefore(uint32_t fromUs, uint32_t toUs) {
  Run run;
  run.line.noiseBefore = {1 / 3., fromUs, toUs};
  return run;
}

// The cut is in a frame of one receiver and in a frame of another. Together, what is left of them is never as long as a
// frame: nothing would tell it from one.
void swapped(Run &run, Random &random) {
  Cut &cut = run.line.cut;
  cut.swaps = true;
  cut.fromFrame = 10;
  cut.toFrame = 11;
  cut.fromCharacter = random.below(sbus::FrameSize);
  cut.toCharacter = (cut.fromCharacter + 2 + random.below(sbus::FrameSize - 2)) % sbus::FrameSize;
  run.line.frames = 25;
}
void swappedSoon(Run &run, Random &random) {
  swapped(run, random);
  run.line.cut.silenceUs = random.below(3000);
}
void swappedLater(Run &run, Random &random) {
  swapped(run, random);
  run.line.cut.silenceUs = 3000 + random.below(run.line.periodUs - 3000);
}

}  // namespace

// Why a frame may be wrong where nothing is promised:
// - Parts of two stretched frames may be joined if one of them ends where half of a Grasshopper's ring is full.
// - Noise that ends where half of a Grasshopper's ring is full is followed by a silence that the port does not see.
// - Where no gap is seen, the parts of two frames look like one: also if a silence within a frame is seen.
// - Noise that ends less than two characters before a frame touches it, as far as a port can tell that waits for an
//   idle character: a header in the noise begins a frame.
// - The frames of another receiver continue one of the first: its first 25 characters may end as a frame does.
const std::vector<Condition> &senderLines() {
  static const std::vector<Payload> joinSticks = {Payload::ShiftedStill, Payload::Shifted, Payload::OtherEnd};
  static const std::vector<Condition> lines = {
      {"clean, 180 us from character to character", every(180), polled(), None},
      {"clean, 200 us from character to character", every(200), polled(), None},
      {"clean, 240 us from character to character", every(240), polled(), NeverWrong},
      {"clean, 120 to 240 us from character to character", atRandom(), seen(), NeverWrong},
      {"clean, 120 to 240 us from character to character, gaps not seen", atRandom(), hidden(), None},
      {"clean, 2 silences in each frame", interrupted(2), seen(), NeverWrong},
      {"clean, 2 silences in each frame, gaps not seen", interrupted(2), hidden(), None},
      {"clean, 3 silences in each frame", interrupted(3), seen(), NeverWrong},
      {"clean, 3 silences in each frame, gaps not seen", interrupted(3), hidden(), None},
      {"clean, silences elsewhere in each frame", plain(), seen(), NeverWrong, {}, interruptedElsewhere},
      {"clean, silences elsewhere in each frame, gaps not seen", plain(), hidden(), None, {}, interruptedElsewhere},
      {"clean, 700 us after 12 characters", interruptedAfter(12, 700), polled(), NeverWrong},
      {"called back: clean, 180 us from character to character", every(180), called(), NeverWrong},
      {"called back: clean, 200 us from character to character", every(200), called(), NeverWrong},
      {"called back: clean, 240 us from character to character", every(240), called(), NeverWrong},
      {"called back: clean, 120 to 240 us from character to character", atRandom(), called(), NeverWrong},
      {"called back: clean, 2 silences in each frame", interrupted(2), called(), NeverWrong},
      {"called back: clean, 3 silences in each frame", interrupted(3), called(), NeverWrong},
      {"called back: clean, silences elsewhere in each frame", plain(), called(), NeverWrong, {}, interruptedElsewhere},
      {"called back: clean, 700 us after 12 characters", interruptedAfter(12, 700), called(), NeverWrong},
      {"clean, periods 750 us shorter or longer", unsteady(), polled(), NeverWrong},
      {"periods 750 us shorter or longer, dropped 1/300", unsteady(dropped(1 / 300.)), seen(), NeverWrong},
      {"called back: clean, periods 750 us shorter or longer", unsteady(), called(), NeverWrong},
      {"called back: periods 750 us shorter or longer, dropped 1/300", unsteady(dropped(1 / 300.)), called(),
       NeverWrong},
      {"inexact frames, dropped 1/300", dropped(1 / 300.), seen(), NeverWrong, {}, inexact},
      {"inexact frames, dropped 1/300, gaps not seen", dropped(1 / 300.), hidden(), None, {}, inexact},
      {"called back: inexact frames, dropped 1/300", dropped(1 / 300.), called(), NeverWrong, {}, inexact},
      {"inexact frames, noise in 1/10 gaps", noise(1 / 10.), polled(), None, {}, inexact},
      {"called back: inexact frames, noise in 1/10 gaps", noise(1 / 10.), called(), None, {}, inexact},
      {"inexact frames, unplugged, and again", Run(), seen(), NeverWrong, joinSticks, inexactAndUnplugged},
      {"inexact frames, unplugged, and again, gaps not seen", Run(), hidden(), None, joinSticks, inexactAndUnplugged},
      {"called back: inexact frames, unplugged, and again", Run(), called(), None, joinSticks, inexactAndUnplugged},
      {"1 to 4 characters of noise, 60 to 200 us, a frame", noiseBefore(60, 200), byCharacter(), None},
      {"1 to 4 characters of noise, 240 to 1500 us, a frame", noiseBefore(240, 1500), byCharacter(), NeverWrong},
      {"called back: 1 to 4 characters of noise, 60 to 200 us, a frame", noiseBefore(60, 200), called(), None},
      {"called back: 1 to 4 characters of noise, 240 to 1500 us, a frame", noiseBefore(240, 1500), called(), None},
      {"another receiver in mid frame, at once", Run(), seen(), None, {}, swapped},
      {"another receiver in mid frame, within 3 ms", Run(), seen(), None, {}, swappedSoon},
      {"another receiver in mid frame, after 3 ms or more", Run(), seen(), NeverWrong, {}, swappedLater},
      {"called back: another receiver in mid frame, at once", Run(), called(), None, {}, swapped},
      {"called back: another receiver in mid frame, within 3 ms", Run(), called(), None, {}, swappedSoon},
      {"called back: another receiver in mid frame, after 3 ms or more", Run(), called(), NeverWrong, {}, swappedLater},
  };
  return lines;
}

// A port that delivers each character at once, and sees the most of what a sender does within a frame.
const std::vector<Condition> &stretchedLines() {
  static const std::vector<Condition> lines = [] {
    std::vector<Condition> all;
    for (uint32_t loopMs = 1; loopMs <= 5; loopMs++) {
      const auto add = [&](const std::string &name, Run run) {
        run.line.frames = 500;
        all.push_back({name + ", loop of " + std::to_string(loopMs) + " ms",
                       run,
                       {{9000, 1000 * loopMs, Pico, 256}, {14000, 1000 * loopMs, Pico, 256}},
                       None,
                       ordinarySticks()});
      };
      add("clean, 200 us from character to character", every(200));
      add("clean, 235 us from character to character", every(235));
      add("clean, 3 silences of 480 us in each frame", interruptedFor(480, 3));
    }
    return all;
  }();
  return lines;
}
