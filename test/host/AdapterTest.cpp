// A line behind a USB adapter, which hands bytes over late and in lumps: no frame is missed, none is made up, and a gap
// is believed only where reads prove it.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <map>
#include <ostream>
#include <string>
#include <vector>

#include "impairment/ImpairedLine.h"
#include "line/Observer.h"
#include "line/ports/PortReads.h"
#include "line/recording/RecordedLine.h"
#include "line/recording/Recording.h"
#include "line/recording/RecordingWriter.h"
#include "line/recording/RestoredLine.h"
#include "support/Adapter.h"
#include "support/Bytes.h"

using line::Character;
using line::Stretch;

namespace {

constexpr uint64_t Seed = 20181;
constexpr uint32_t Latencies[] = {1000, 2000, 4000, 8000, 16000};  // us
constexpr unsigned Dozen = 12;

struct Row {
  const char *name;
  Kind kind;
  unsigned slots;
  uint32_t periodUs;
};
constexpr Row Rows[] = {
    {"16 channels", Kind::Plain, 0, 4000},        {"16 channels", Kind::Plain, 0, 6300},
    {"16 channels", Kind::Plain, 0, 9000},        {"16 channels", Kind::Plain, 0, 15000},
    {"24 channels", Kind::Channels24, 0, 5000},   {"24 channels", Kind::Channels24, 0, 9000},
    {"24 channels", Kind::Channels24, 0, 15000},  {"S.BUS2, 2 slots", Kind::Sbus2, 2, 7000},
    {"S.BUS2, 2 slots", Kind::Sbus2, 2, 15000},   {"S.BUS2, 8 slots", Kind::Sbus2, 8, 15000},
    {"FASSTest 26", Kind::With2F, 0, 14000},      {"FASSTest 26", Kind::With2F, 0, 18000},
    {"R7003SB", Kind::R7003SB, 0, 7000},          {"R7003SB", Kind::R7003SB, 0, 15000},
};

struct Count {
  unsigned long sent = 0;
  unsigned long missed = 0;  // after the first dozen
  unsigned long wrong = 0;   // stood nowhere on the line
  bool operator==(const Count &other) const { return missed == other.missed && wrong == other.wrong; }
};
std::ostream &operator<<(std::ostream &out, const Count &count) {
  return out << count.missed << " of " << count.sent << " missed, " << count.wrong << " wrong";
}

// A program that reads the adapter by poll(): `stallUs`, one read in 20 finds it late by up to so much.
class Program {
 public:
  Program(uint32_t latencyUs, uint32_t stallUs, line::Random &random)
      : _reads(line::CharacterUs, latencyUs), _adapter(latencyUs, random), _stallUs(stallUs), _random(random) {}

  void put(const Character &character) {
    _adapter.put(character, [this](const Read &read) { arrived(read); });
  }

  // Nothing comes up to then.
  void idleUntil(uint64_t us) {
    _adapter.runTo(us, [this](const Read &read) { arrived(read); });
    catchUp(us);
    lookUntil(us);
  }

  line::Observer observer;
  line::RecordingWriter recorder;

 private:
  void arrived(const Read &brought) {
    catchUp(brought.us);
    if (_busyUntilUs > brought.us) {
      _waiting.insert(_waiting.end(), brought.characters.begin(), brought.characters.end());
      return;
    }
    lookUntil(brought.us);
    read(brought.us, brought.characters);
    _busyUntilUs = _stallUs != 0 && _random.below(20) == 0 ? brought.us + _random.below(_stallUs) : 0;
  }

  // What came while the program was busy.
  void catchUp(uint64_t us) {
    if (!_waiting.empty() && _busyUntilUs <= us) {
      read(_busyUntilUs, _waiting);
      _waiting.clear();
    }
    _lookUs = std::max(_lookUs, std::min(us, _busyUntilUs));
  }

  void read(uint64_t us, const std::vector<Character> &characters) {
    _lookUs = us;
    _reads.begin(characters.size(), us);
    for (const Character &sent : characters) {
      const Character character = _reads.next(sent.value, sent.bad);
      recorder.put(character);
      observer.put(character);
    }
  }

  // Its poll() returns with nothing.
  void lookUntil(uint64_t us) {
    while ((_lookUs += static_cast<uint64_t>(_reads.knownAfterMs()) * 1000) < us) {
      _reads.empty(_lookUs);
      observer.idleUntil(_reads.knownUs());
    }
  }

  line::PortReads _reads;
  Adapter _adapter;
  uint32_t _stallUs;
  line::Random &_random;
  uint64_t _lookUs = 0;
  uint64_t _busyUntilUs = 0;
  std::vector<Character> _waiting;
};

// The frames of a line and where they stood, held against those that an observer has found.
class Judge {
 public:
  void sent(const SentFrame &frame, uint64_t skipped) {
    if (frame.first < skipped) {
      return;  // it began before the port was opened
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

// Those that a sketch finds, which polls a board's port each millisecond.
unsigned long framesOfSketch(const line::Recording &recording) {
  line::RestoredLine line(std::make_unique<line::RecordedLine>(recording), line::CharacterUs);
  sbus::FrameFinder finder;
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

TEST_CASE("an adapter at each latency, ordinary sticks: no frame is missed after the first dozen, and none is wrong") {
  std::printf("missed after the first dozen + wrong, of some 10000 frames (20000 of FASSTest 26); seed %lu\n",
              static_cast<unsigned long>(Seed));
  std::printf("%-16s   T/ms     1 ms    2 ms    4 ms    8 ms   16 ms\n", "latency");
  for (const Row &row : Rows) {
    CAPTURE(row.name);
    CAPTURE(row.periodUs);
    std::printf("%-16s %6.1f ", row.name, row.periodUs / 1000.);
    for (const uint32_t latencyUs : Latencies) {
      CAPTURE(latencyUs);
      const Count count = runs(row, latencyUs, 0, 10);
      std::printf(" %4lu+%-2lu", count.missed, count.wrong);
      CHECK(count.sent > 10000);
      CHECK(count == Count());
    }
    std::printf("\n");
  }
}

TEST_CASE("on a busy PC, which reads up to 100 ms late, just so") {
  for (const Row &row : Rows) {
    CAPTURE(row.name);
    CAPTURE(row.periodUs);
    for (const uint32_t latencyUs : {1000u, 16000u}) {
      CAPTURE(latencyUs);
      CHECK(runs(row, latencyUs, 100000, 2) == Count());
    }
  }
}

TEST_CASE("a recording of it keeps what each read brought: decoded again it has the same frames") {
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
      CHECK(framesOfSketch(recording) + Dozen + Dozen > count.sent);  // the sketch has a beginning of its own
    }
  }
}

TEST_CASE("a recording: what two reads brought stands on two lines, even back to back") {
  line::PortReads reads;
  line::RecordingWriter writer;
  reads.empty(100000);
  for (const uint64_t us : {uint64_t{101000}, uint64_t{101120}}) {
    reads.begin(2, us);
    writer.put(reads.next(0x0F));
    writer.put(reads.next(0xE5, true));
  }
  writer.finish();
  CHECK(writer.take() == "100880~19000 0F E5!\n101120~19120 0F E5!\n");
}

// Its frame's last 25 bytes look like one of 16 channels.
TEST_CASE("24 channels whose tenth byte of payload is a header's, at 16 ms: no frame of 16") {
  for (uint64_t seed = Seed; seed < Seed + 300; seed++) {
    CAPTURE(seed);
    line::Random random(seed);
    std::vector<uint8_t> bytes(36);
    std::generate_n(bytes.begin() + 1, 33, [&random] { return random.byte(); });
    bytes[0] = bytes[11] = sbus::HeaderByte;
    Program program(16000, 0, random);
    size_t frames16 = 0;
    size_t frames24 = 0;
    program.observer.listen([&](const Stretch &stretch) {
      frames16 += stretch.kind == Stretch::Kind::Frame;
      frames24 += stretch.kind == Stretch::Kind::Frame24;
    });
    const size_t skipped = random.below(36);
    for (size_t i = skipped; i < 40 * bytes.size(); i++) {
      Character character;
      character.endUs = i / 36 * 9000 + (i % 36 + 1) * line::CharacterUs;
      character.value = bytes[i % 36];
      program.put(character);
    }
    program.idleUntil(500000);
    program.observer.finish();
    CHECK(frames16 == 0);
    CHECK(frames24 + Dozen >= 39);
  }
}

TEST_CASE("pulled in mid frame and plugged in again: the halves are no frame if reads prove the silence") {
  const struct {
    uint32_t latencyUs;
    uint32_t silenceUs;
  } rows[] = {{1000, 10000}, {16000, 40000}, {16000, 500000}};
  for (const auto &row : rows) {
    CAPTURE(row.latencyUs);
    CAPTURE(row.silenceUs);
    line::Random random(Seed);
    Program program(row.latencyUs, 0, random);
    size_t frames = 0;
    program.observer.listen([&](const Stretch &stretch) { frames += stretch.isFrame(); });
    PayloadFrames sticks(Payload::Smooth, random);
    uint64_t us = 20000;
    const auto send = [&](size_t from, size_t to) {
      const Frame frame = sticks.next();
      for (size_t i = from; i < to; i++) {
        Character character;
        character.endUs = us += line::CharacterUs;
        character.value = frame[i];
        program.put(character);
      }
    };
    for (int i = 0; i < 20; i++, us += 6000) {
      send(0, sbus::FrameSize);
    }
    send(0, 12);
    us += row.silenceUs;
    send(12, sbus::FrameSize);
    for (int i = 0; i < 20; i++) {
      us += 6000;
      send(0, sbus::FrameSize);
    }
    program.idleUntil(us + 500000);
    program.observer.finish();
    CHECK(frames == 40);
    CHECK(program.observer.counters().discardedBytes == sbus::FrameSize);
  }
}

TEST_CASE("an impaired frame in the first read of a port that was never found empty: one stretch, with its reason") {
  line::Random random(Seed);
  PayloadFrames sticks(Payload::Neutral, random);
  const Frame good = sticks.next();
  const Bytes bytes = join({good, good, good}) + without(good, 5) + join({good, good});
  line::Observer observer;
  std::vector<Stretch> others;
  size_t frames = 0;
  observer.listen([&](const Stretch &stretch) {
    frames += stretch.isFrame();
    if (!stretch.isFrame()) {
      others.push_back(stretch);
    }
  });
  line::PortReads reads;
  reads.begin(bytes.size(), 1000000);
  for (const uint8_t byte : bytes) {
    observer.put(reads.next(byte));
  }
  observer.finish();
  CHECK(frames == 5);
  REQUIRE(others.size() == 1);
  CHECK(others[0].characters.size() == sbus::FrameSize - 1);
  CHECK(why(others[0]) == "no end byte");
}
