// The parts of which the lines and sketches of the conditions are made.
#pragma once

#include <cstdint>
#include <vector>

#include <sbus/Frame.h>

#include "Simulation.h"

constexpr unsigned long FastBaud = 200000;

inline Run plain() { return {}; }
inline Run of(Kind kind) {
  Run run;
  run.line.kind = kind;
  return run;
}
inline Run with(double Impairments::*impairment, double probability, Kind kind = Kind::Plain) {
  Run run = of(kind);
  run.line.impairments.*impairment = probability;
  return run;
}
inline Run dropped(double probability, Kind kind = Kind::Plain) {
  return with(&Impairments::dropped, probability, kind);
}
// S.BUS2: this number of slots after 04, or after each frame.
inline Run slots(unsigned count, Run run = plain()) {
  run.line.kind = Kind::Sbus2;
  run.line.company.slots = count;
  return run;
}
inline Run slotsAfterEach(unsigned count) {
  Run run = slots(count);
  run.line.company.afterEach = true;
  return run;
}
inline Run noise(double probability) { return with(&Impairments::noise, probability); }
inline Run stopping() {
  Run run;
  run.line.stopEvery = 20;
  return run;
}
inline Run inStep() {
  Run run;
  run.inStep = true;
  return run;
}
// Some receivers take 4 ms for a frame.
inline Run spread() {
  Run run;
  run.line.spreadUs = 40;
  return run;
}
inline Run joined() {
  Run run;
  run.line.frames = 25;
  run.joining = true;
  return run;
}
inline Run blocked(uint32_t fromMs, uint32_t toMs, uint32_t everyMs) {
  Run run;
  run.line.frames = 250;  // 0.75 s of the densest line
  run.blockFromUs = 1000 * fromMs;
  run.blockToUs = 1000 * toMs;
  run.blockEveryUs = 1000 * everyMs;
  return run;
}
inline Run interruptsOff(uint32_t fromMs, uint32_t toMs, uint32_t everyMs) {
  Run run = blocked(fromMs, toMs, everyMs);
  run.blocksInterrupts = true;
  return run;
}
// Unplugged for this number of periods in every 12 frames and these, and plugged in at the same character.
inline Run cut(unsigned periods) {
  Run run;
  run.line.cut = {12, 1, 12 + uint64_t{periods}, 1, 13 + uint64_t{periods}};
  run.line.frames = 24 * run.line.cut.every;  // at each character
  return run;
}
// Unplugged within a frame, and plugged in again within another.
constexpr uint64_t FramesInSync = 20;
constexpr uint64_t FramesAfter = 30;
constexpr uint32_t LongestCut = 9;  // periods
inline void unplugged(Run &run, Random &random) {
  Cut &cut = run.line.cut;
  cut.fromFrame = FramesInSync;
  cut.fromCharacter = random.below(sbus::FrameSize);
  cut.toFrame = FramesInSync + 1 + random.below(LongestCut);
  cut.toCharacter = random.below(sbus::FrameSize);
  run.line.frames = cut.toFrame + 1 + FramesAfter;
}
inline Run by24(Run run) {
  run.reads = Reads::Channels24;
  return run;
}
inline Run by32(Run run) {
  run.reads = Reads::Channels32;
  return run;
}
inline Run long24(Run run) {
  run.line.kind = Kind::Channels24;
  return by24(run);
}
inline Run fast(Run run) {
  run.line.baud = FastBaud;
  return run;
}

// A port that is polled by events has no empty call.
inline std::vector<Setup> byEvents(std::vector<Setup> setups) {
  for (Setup &setup : setups) {
    setup.polling = Polling::ByEvents;
  }
  return setups;
}
