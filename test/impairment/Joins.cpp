#include "Joins.h"

#include <algorithm>
#include <functional>

#include <sbus/Frame.h>

namespace {

constexpr uint64_t FramesInSync = 20;
constexpr uint64_t FramesAfter = 30;
constexpr uint32_t LongestCut = 9;  // periods
constexpr unsigned FirstPlace = 2;  // where a false sync may begin
constexpr unsigned LastPlace = 23;

constexpr const char *Unseen = "no gap is seen, and what may be a false sync is rejected";
constexpr const char *Hidden = "nor is the cut, or the gap after it; then the two parts may be as long as a frame";

// (A port that hands over 8 bytes at once hides so much of a gap of 3.3 ms that a loop of 1 ms misses it now and then:
// one join of about 2000 delivers a frame that was never sent.)
bool gapsAreSeen(const Setup &setup) {
  return setup.periodUs >= (setup.loopUs <= 300 ? 6300 : 7000) && setup.loopUs <= 1000;
}

std::vector<Setup> all() {
  return everyDriver({4000, 6300, 7000, 9000, 14000, 15000}, {50, 300, 1000, 2000, 3000, 4000, 5000});
}
std::vector<Setup> sbus2() {
  return everyDriver({15000}, {50, 300, 1000, 2000, 3000, 4000, 5000});
}
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

// Joins at this character.
Run joined(Join join, const Setup &setup, unsigned character, Random &random) {
  Run run;
  run.setup = setup;
  run.line.periodUs = setup.periodUs;
  run.line.frames = FramesAfter + 1;
  Cut &cut = run.line.cut;
  switch (join) {
    case Join::InStep:
      run.inStep = true;
      run.joining = true;
      run.joinUs = character * run.line.characterUs();
      break;
    case Join::AtBegin:
      run.joining = true;
      run.joinUs = character * run.line.characterUs() + random.below(run.line.characterUs());
      break;
    case Join::AfterSilence:
      run.silenceUs = random.chance(0.5) ? 5000 : 300000;
      cut.toCharacter = character;
      break;
    case Join::AfterCut:
    case Join::SameCharacter:
      cut.fromFrame = FramesInSync;
      cut.fromCharacter = join == Join::SameCharacter ? character : random.below(sbus::FrameSize);
      cut.toFrame = FramesInSync + 1 + random.below(LongestCut);
      cut.toCharacter = character;
      run.line.frames = cut.toFrame + 1 + FramesAfter;
      break;
  }
  return run;
}

}  // namespace

const std::vector<Payload> &JoinLine::sticks() {
  static const std::vector<Payload> sticks = {Payload::ShiftedStill, Payload::Shifted, Payload::OtherEnd};
  return sticks;
}

const std::vector<JoinLine> &joinLines() {
  static const std::vector<JoinLine> lines = {
      {"joined: begin() while the line runs", Join::AtBegin, all(), 0, 0.17, Unseen},
      {"joined: plugged in after silence", Join::AfterSilence, all(), 0, 0.17, Unseen},
      {"joined: unplugged, and again", Join::AfterCut, seen(), 0, 0},
      {"joined: unplugged, and again, gaps not seen", Join::AfterCut, hidden(), 0.04, 0.25, Hidden},
      {"joined: unplugged, and again at the same character", Join::SameCharacter, seen(), 0, 0},
      {"joined: unplugged, and again at the same character, gaps not seen", Join::SameCharacter, hidden(), 0.04, 0.25,
       Hidden},
      {"joined: loop in step", Join::InStep, all(), 0, 0.19, Unseen},
      {"joined: begin() while an S.BUS2 line runs", Join::AtBegin, sbus2(), 0, 0, "", Kind::Sbus2},
  };
  return lines;
}

JoinTally &JoinTally::operator+=(const JoinTally &other) {
  joins += other.joins;
  misled += other.misled;
  unseen += other.unseen;
  frames += other.frames;
  return *this;
}

JoinTally impairment(const JoinLine &line, const Setup &setup, Payload sticks, Decoder decoder, unsigned stride,
                  uint64_t seed) {
  Random random(ownSeed(line.name, setup, sticks, seed));
  JoinTally sum;
  for (unsigned place = FirstPlace; place <= LastPlace; place++) {
    for (unsigned character = random.below(stride); character < sbus::FrameSize; character += stride) {
      Run run = joined(line.join, setup, character, random);
      run.line.sticks = sticks;
      run.line.place = place;
      run.line.kind = line.kind;
      const Tally tally = simulate(run, decoder, random.next());
      sum += {1, tally.wrong != 0, tally.joined == 0, tally};
    }
  }
  return sum;
}

unsigned joinStride(uint64_t frames) {
  return static_cast<unsigned>(std::clamp<uint64_t>(60000 / frames, 1, 1000));
}
