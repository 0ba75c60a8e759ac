// A line behind a USB adapter, which hands bytes over late and in packets: no frame is missed or made up, and a gap
// counts only where reads prove it.
#include <doctest/doctest.h>

#include <cstdio>
#include <map>
#include <ostream>
#include <string>
#include <vector>

#include "impairment/ImpairedLine.h"
#include "impairment/Settings.h"
#include "line/recording/RecordedLine.h"
#include "line/recording/RecordingReader.h"
#include "line/recording/RestoredLine.h"
#include "sbus/ExtraFrame.h"
#include "support/AdapterProgram.h"
#include "support/Bytes.h"

namespace {

const uint64_t Seed = seedOfDay();
constexpr uint32_t Latencies[] = {1000, 2000, 4000, 8000, 16000};  // us
constexpr unsigned Dozen = 12;
#ifdef __SANITIZE_ADDRESS__
constexpr unsigned Thousands = 1;  // of frames on each line: the sanitizers take four times as long
#else
constexpr unsigned Thousands = 3;
#endif

struct Row {
  const char *name;
  Kind kind;
  unsigned slots;
  uint32_t periodUs;
};
constexpr Row Rows[] = {
    {"16 channels", Kind::Plain, 0, 4000},       {"16 channels", Kind::Plain, 0, 6300},
    {"16 channels", Kind::Plain, 0, 9000},       {"16 channels", Kind::Plain, 0, 15000},
    {"24 channels", Kind::Channels24, 0, 5000},  {"24 channels", Kind::Channels24, 0, 9000},
    {"24 channels", Kind::Channels24, 0, 15000}, {"S.BUS2, 2 slots", Kind::Sbus2, 2, 7000},
    {"S.BUS2, 2 slots", Kind::Sbus2, 2, 15000},  {"S.BUS2, 8 slots", Kind::Sbus2, 8, 15000},
    {"FASSTest 26", Kind::With2F, 0, 14000},     {"FASSTest 26", Kind::With2F, 0, 18000},
    {"R7003SB", Kind::R7003SB, 0, 7000},         {"R7003SB", Kind::R7003SB, 0, 15000},
};

struct Count {
  unsigned long sent = 0;
  unsigned long missed = 0;  // after the first dozen
  unsigned long wrong = 0;   // were nowhere on the line
  bool operator==(const Count &other) const { return missed == other.missed && wrong == other.wrong; }
};
std::ostream &operator<<(std::ostream &out, const Count &count) {
  return out << count.missed << " of " << count.sent << " missed, " << count.wrong << " wrong";
}

// Compares the frames of a line and their places with those that an observer has found.
class Judge {
 public:
  void sent(const SentFrame &frame, uint64_t skipped) {
    if (frame.first < skipped) {
      return;  // the frame began before the port was opened
    }
    const Stretch::Kind kind = frame.extra                     ? Stretch::Kind::Extra
                               : frame.size == sbus::FrameSize ? Stretch::Kind::Frame
                                                               : Stretch::Kind::Frame24;
    _sent.push_back({frame.first - skipped, kind});
  }
  void found(const Stretch &stretch) {
    if (stretch.isFrame()) {
      _found[stretch.at] = stretch.kind;
    }
  }
  void addTo(Count &count) const {
    size_t right = 0;
    for (size_t i = 0; i < _sent.size(); i++) {
      const auto at = _found.find(_sent[i].first);
      const bool isFound = at != _found.end() && at->second == _sent[i].second;
      right += isFound;
      count.missed += !isFound && i >= Dozen;
    }
    count.sent += _sent.size();
    count.wrong += _found.size() - right;
  }

 private:
  std::vector<std::pair<uint64_t, Stretch::Kind>> _sent;
  std::map<uint64_t, Stretch::Kind> _found;
};

Transmission transmission(const Row &row, Payload sticks, uint64_t frames) {
  Transmission sent;
  sent.kind = row.kind;
  sent.sticks = sticks;
  sent.periodUs = row.periodUs;
  sent.frames = frames;
  sent.company.slots = row.slots;
  sent.company.afterEach = true;
  return sent;
}

// The port is opened somewhere in the first three frames.
void run(const Row &row, Payload sticks, uint32_t latencyUs, uint32_t stallUs, uint64_t seed, uint64_t frames,
         Count &count, std::string *recording = nullptr) {
  line::Random random(seed);
  ImpairedLine line(transmission(row, sticks, frames), random.below(9000), random);
  Program program(latencyUs, stallUs, random);
  Judge judge;
  program.observer.listen([&judge](const Stretch &stretch) { judge.found(stretch); });
  const uint64_t skipped = random.below(3 * sbus::FrameSize);
  uint64_t us = 0;
  Character character;
  for (uint64_t number = 0; line.nextUs() != UINT64_MAX; number++) {
    us = line.nextUs();
    line.next(us, character);
    if (number >= skipped) {
      program.put(character);
    }
    for (SentFrame frame; line.nextSent(frame);) {
      judge.sent(frame, skipped);
    }
  }
  program.idleUntil(us + 500000);
  program.observer.finish();
  judge.addTo(count);
  if (recording != nullptr) {
    program.recorder.finish();
    *recording = program.recorder.take();
  }
}

Count runs(const Row &row, uint32_t latencyUs, uint32_t stallUs, unsigned seeds) {
  Count count;
  for (const Payload sticks : ordinarySticks()) {
    for (uint64_t seed = Seed; seed < Seed + seeds; seed++) {
      run(row, sticks, latencyUs, stallUs, seed, 155, count);
    }
  }
  return count;
}

// Returns the frames found by a sketch that polls a board's port each millisecond.
unsigned long framesOfSketch(const line::Recording &recording) {
  line::RestoredLine line(std::make_unique<line::RecordedLine>(recording), line::CharacterUs);
  sbus::FrameFinderOf<sbus::Frame16Extra, sbus::ExtraFrame> finder;
  line.opened(0);
  for (uint64_t us = 0; !line.finished(us); us += 1000) {
    Bytes bytes;
    for (Character character; line.next(us, character);) {
      bytes.push_back(character.value);
    }
    if (bytes.empty()) {
      finder.idle(static_cast<uint32_t>(us));
      continue;
    }
    finder.poll(static_cast<unsigned>(bytes.size()), static_cast<uint32_t>(us));
    for (size_t i = 0; i < bytes.size(); i++) {
      *finder.space() = bytes[i];
      finder.received(1, static_cast<int>(bytes.size() - 1 - i));
    }
  }
  return finder.counters().frames + finder.counters().extraFrames;
}

}  // namespace

TEST_CASE(
    "with an adapter of any latency and ordinary sticks no frame is missed after the first dozen, and none is wrong") {
  std::printf("missed after the first dozen + wrong, of some %u000 frames (twice as many of FASSTest 26); seed %lu\n",
              Thousands, static_cast<unsigned long>(Seed));
  std::printf("%-16s   T/ms     1 ms    2 ms    4 ms    8 ms   16 ms\n", "latency");
  for (const Row &row : Rows) {
    CAPTURE(row.name);
    CAPTURE(row.periodUs);
    std::printf("%-16s %6.1f ", row.name, row.periodUs / 1000.);
    for (const uint32_t latencyUs : Latencies) {
      CAPTURE(latencyUs);
      const Count count = runs(row, latencyUs, 0, Thousands);
      std::printf(" %4lu+%-2lu", count.missed, count.wrong);
      CHECK(count.sent > 1000 * Thousands);
      CHECK(count == Count());
    }
    std::printf("\n");
  }
}

TEST_CASE("on a busy PC, which reads up to 100 ms late, no frame is missed, and none is wrong") {
  for (const Row &row : Rows) {
    CAPTURE(row.name);
    CAPTURE(row.periodUs);
    for (const uint32_t latencyUs : {1000u, 16000u}) {
      CAPTURE(latencyUs);
      CHECK(runs(row, latencyUs, 100000, 2) == Count());
    }
  }
}

TEST_CASE("a recording of an adapter keeps what each read brought: decoded again, it has the same frames") {
  for (const Row &row : Rows) {
    CAPTURE(row.name);
    CAPTURE(row.periodUs);
    Count count;
    std::string text;
    run(row, Payload::Smooth, 16000, 0, Seed, 155, count, &text);
    CHECK(text.find('~') != std::string::npos);
    const line::Recording recording = line::parseRecording(text);
    REQUIRE(recording.error.empty());
    line::Observer observer;
    line::RecordingWriter again;
    for (const Character character : recording.characters) {
      observer.put(character);
      again.put(character);
    }
    observer.finish();
    again.finish();
    CHECK(again.take() == text);
    const auto frames = observer.counters().frames + observer.counters().extraFrames;
    CHECK(frames + Dozen > count.sent);
    if (row.kind != Kind::Channels24) {
      CHECK(framesOfSketch(recording) + Dozen + Dozen > count.sent);  // the sketch also misses the first dozen
    }
  }
}
