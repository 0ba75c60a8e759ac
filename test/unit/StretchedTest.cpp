// Frames whose sender stretches them: with gaps inside, they are delivered once the line is known to have such frames.
// Parts of two frames never are.
#include <doctest/doctest.h>

#include <algorithm>
#include <initializer_list>
#include <string>

#include "sbus/FrameFinder.h"
#include "support/Feed.h"
#include "support/ShowArrays.h"

namespace {

// What a port that hands over each character at once shows.
constexpr uint32_t LeastUs = 2 * Feeder::CharacterUs + 1;    // a gap
constexpr uint32_t MostUs = 2 * Feeder::CharacterUs + 1500;  // within a frame
constexpr uint32_t WideUs = MostUs + 1;
constexpr uint32_t LongUs = 50000;  // the next character may be anywhere in a frame

// A line in sync, whose variant is known.
struct Line : Feeder {
  unsigned number = 3;  // of the next frame

  Line() {
    finder.reset(now, CharacterUs, 0);
    lock();
  }

  // Sends a frame and the silence after it. Returns "it" if it is delivered, "nothing", or "another".
  std::string whole(uint32_t afterUs = WideUs) {
    const Frames frames = feed(bytesOf(neutralFrame(number++)));
    return named(frames + wait(afterUs).waited);
  }
  // Sends a frame with a silence inside.
  std::string stretched(size_t place = 12, uint32_t insideUs = LeastUs, uint32_t afterUs = WideUs) {
    const Frame frame = neutralFrame(number++);
    Frames frames = feed(part(frame, 0, place));
    frames = frames + wait(insideUs).waited;
    frames = frames + feed(part(frame, place));
    return named(frames + wait(afterUs).waited);
  }
  std::string named(const Frames &frames) const {
    return frames.empty() ? "nothing" : frames == Frames{neutralFrame(number - 1)} ? "it" : "another";
  }

  // The line is known to have stretched frames.
  Line &learn() {
    REQUIRE(stretched() == "nothing");
    REQUIRE(stretched() == "it");
    return *this;
  }
};

// The parts of two frames that a line joins, `periods` apart, again and again, at each place.
void joinParts(std::initializer_list<uint32_t> periodsUs) {
  const struct {
    uint8_t idle;
    size_t burst;
    uint32_t insideUs;  // the longest silence within a frame
  } ports[] = {{0, 1, MostUs}, {1, 16, 13 * 240 + 120 + 1500}, {4, 8, 8 * 240 + 480 + 1500}};
  for (const auto &port : ports) {
    for (const uint32_t periodUs : periodsUs) {
      for (const unsigned periods : {1u, 2u, 3u}) {
        for (const bool isStretched : {false, true}) {
          // A header and the 24 characters of another frame after its header are that frame.
          for (size_t place = periodUs < 6000 ? 2 : 1; place < 25; place++) {
            INFO("idle ", unsigned{port.idle}, ", periodUs ", periodUs, ", periods ", periods, ", isStretched ",
                 isStretched, ", place ", place);
            Line line;
            line.finder.reset(line.now, Line::CharacterUs, port.idle);
            const uint32_t silentUs = periodUs - 25 * Line::CharacterUs;
            line.settle(Line::CharacterUs, LongUs);
            Frames sent, found;
            const auto whole = [&] {
              sent.push_back(neutralFrame(line.number++));
              found = found + line.feed(bytesOf(sent.back()), port.burst);
              found = found + line.wait(silentUs).waited;
            };
            const auto wholes = [&] {
              for (unsigned i = 0; i < 3; i++) {
                whole();
              }
            };
            wholes();
            for (unsigned i = 0; isStretched && i < 2; i++) {
              sent.push_back(neutralFrame(line.number++));
              found = found + line.feed(part(sent.back(), 0, 12), port.burst);
              line.wait(port.insideUs);
              found = found + line.feed(part(sent.back(), 12), port.burst);
              found = found + line.wait(LongUs - 1).waited;
            }
            for (unsigned i = 0; isStretched && i < 10; i++) {
              wholes();  // after these silences the measured period becomes the line's again
            }
            // The connector opens and closes again and again, always at the same place of a frame. loop() polls each
            // 500 us.
            for (unsigned cut = 0; cut < 4; cut++) {
              found = found + line.feed(part(neutralFrame(line.number), 0, place), port.burst);
              const uint32_t openUs = periods * periodUs;
              for (uint32_t us = 500; us <= openUs - 500; us += 500) {
                found = found + line.wait(500).waited;
              }
              line.block(openUs - openUs / 500 * 500 + 500);
              found = found + line.feed(part(neutralFrame(line.number + periods), place), port.burst);
              found = found + line.wait(silentUs).waited;
              line.number += periods + 1;
              if (cut % 2 != 0) {
                wholes();
              }
            }
            const auto wrong = [&](const Frame &frame) {
              return std::find(sent.begin(), sent.end(), frame) == sent.end();
            };
            CHECK(std::none_of(found.begin(), found.end(), wrong));
            CHECK(found.size() + 4 >= sent.size());
            CHECK(found.back() == sent.back());
          }
        }
      }
    }
  }
}

}  // namespace

TEST_CASE("the second frame with a gap inside is delivered, with at most two others between, and so are all after it") {
  for (size_t place = 1; place < 25; place++) {
    for (unsigned between = 0; between < 5; between++) {
      INFO("place ", place, ", between ", between);
      Line line;
      CHECK(line.stretched(place) == "nothing");
      for (unsigned i = 0; i < between; i++) {
        CHECK(line.whole() == "it");
      }
      CHECK(line.stretched(place) == (between <= 2 ? "it" : "nothing"));
      CHECK(line.stretched(25 - place) == "it");
      CHECK(line.stretched(place) == "it");
      CHECK(line.whole() == "it");
      CHECK(line.counted().discardedBytes == (between <= 2 ? 25 : 50));
    }
  }
}

TEST_CASE("frames with a gap after each character are delivered from the second on, after the silence that ends them") {
  for (const bool isKnown : {false, true}) {
    CAPTURE(isKnown);
    Line line;
    if (!isKnown) {
      line.finder.reset(line.now, Line::CharacterUs, 0);
      line.settle();
    }
    for (unsigned number = 0; number < 10; number++) {
      CAPTURE(number);
      for (const uint8_t byte : neutralFrame(number)) {
        CHECK(line.wait(LeastUs).waited.empty());
        CHECK(line.feed({byte}).empty());
      }
      if (isKnown && number < 6) {  // these take longer than frames did, and are not in time until that is known
        line.wait(LeastUs).wait(WideUs);
        continue;
      }
      const Frames frames = number == 0 ? Frames{} : Frames{neutralFrame(number)};
      if (number >= 2) {
        CHECK(line.wait(LeastUs).waited == frames);
        CHECK(line.wait(WideUs).waited.empty());
      } else {  // a gap that is not wide may lie within this one
        CHECK(line.wait(LeastUs).waited.empty());
        CHECK(line.wait(MostUs - LeastUs).waited.empty());
        CHECK(line.wait(1).waited == frames);
        line.wait(MostUs);
      }
    }
  }
}

TEST_CASE(
    "a stretched frame begins in sync, or after a wide gap; a gap that is not wide may lie within another frame") {
  const struct {
    const char *what;
    Bytes before;    // characters that belong to no frame, and out of sync
    uint32_t gapUs;  // after them
    bool isDelivered;
  } rows[] = {
      {"in sync", {}, LeastUs, true},
      {"in sync, without a gap before it", {}, 0, true},
      {"after a character, without a gap", {0x55}, 0, false},
      {"after a character and a gap", {0x55}, LeastUs, false},
      {"... and the longest gap within a frame", {0x55}, MostUs, false},
      {"... and a wide gap", {0x55}, WideUs, true},
      {"after the rest of a frame and a gap", part(neutralFrame(1), 7), LeastUs, false},
      {"... and a wide gap", part(neutralFrame(1), 7), WideUs, true},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    Line line;
    line.learn();
    CHECK(line.whole(LeastUs) == "it");
    if (!row.before.empty()) {
      line.feed(row.before);
    }
    if (row.gapUs != 0) {
      line.wait(row.gapUs);
    }
    CHECK(line.stretched() == (row.isDelivered ? "it" : "nothing"));
    CHECK(line.whole() == "it");
  }
}

TEST_CASE("a wide gap inside rejects, at each place; a gap of up to 1.5 ms more than the characters take does not") {
  for (size_t place = 1; place < 25; place++) {
    for (const uint32_t us : {LeastUs, MostUs, WideUs, uint32_t{9000}, LongUs - 1, LongUs, uint32_t{100000}}) {
      INFO("place ", place, ", us ", us);
      Line line;
      line.learn();
      CHECK(line.stretched(place, us) == (us <= MostUs ? "it" : "nothing"));
      CHECK(line.whole() == "it");
    }
  }
}

TEST_CASE("that a sender stretches frames is forgotten after a hundred without gaps inside") {
  for (const unsigned whole : {98u, 99u, 100u, 101u}) {
    CAPTURE(whole);
    Line line;
    line.learn();
    for (unsigned i = 0; i < whole; i++) {
      REQUIRE(line.whole() == "it");
    }
    CHECK(line.stretched() == (whole < 100 ? "it" : "nothing"));
    CHECK(line.stretched() == "it");
  }
}

TEST_CASE(
    "the parts of two frames that a line joins, one period or more apart, are never a frame, whether or not the sender "
    "stretches frames") {
  joinParts({6000, 6300, 7000, 9000, 14000, 15000});
}

TEST_CASE("... nor if frames come each 4 or 5 ms") { joinParts({4000, 5000}); }

TEST_CASE("a gap inside that is only likely rejects, and shows all the same that the sender stretches frames") {
  // The port has handed over 12 characters, and 13 more so late that these may not follow them directly.
  const auto likely = [](Line &line) {
    const Frame frame = neutralFrame(line.number++);
    REQUIRE(line.finder.mayWait(12, line.now += 12 * Line::CharacterUs));
    line.finder.pollIdling(25, line.now += 13 * 2 * Line::CharacterUs + LeastUs, true, false);
    std::copy(frame.begin(), frame.end(), line.finder.space());
    CHECK(line.finder.received(25, 0) == nullptr);
    return line.named(line.wait(WideUs).waited);
  };
  Line line;
  CHECK(likely(line) == "nothing");
  CHECK(line.stretched() == "it");
  CHECK(likely(line) == "nothing");
  CHECK(line.stretched() == "it");
  CHECK(line.whole() == "it");
}

TEST_CASE(
    "where no call sees a gap: the second frame that comes late, but when it is due, is delivered with its last byte, "
    "and so are all after it") {
  constexpr uint32_t LoopUs = 3000, PeriodUs = 3 * LoopUs;
  // In the first call some characters of a frame, in the second 15, and in the third the rest: each takes 200 us. All
  // calls find bytes. `missed`: whole periods without a character after the first call.
  const auto late = [](Line &line, size_t first, uint32_t missed = 0) {
    const Frame begun = neutralFrame(line.number), frame = neutralFrame(line.number += missed);
    line.number++;
    Frames found = line.block(LoopUs).poll(part(begun, 0, first));
    found = found + line.block(LoopUs + missed * PeriodUs).poll(part(frame, first, first + 15));
    return line.named(found + line.block(LoopUs).poll(part(frame, first + 15)));
  };
  for (size_t first = 2; first <= 9; first++) {
    for (const uint32_t missed : {1u, 2u, 9u}) {
      INFO("first ", first, ", missed ", missed);
      Line line;
      for (unsigned frames = 0; frames < 50; frames++) {
        REQUIRE(line.whole(PeriodUs - 25 * Line::CharacterUs) == "it");
      }
      CHECK(late(line, first) == "nothing");
      for (unsigned frames = 0; frames < 5; frames++) {
        CHECK(late(line, first) == "it");
      }
      CHECK(late(line, first, missed) == "nothing");  // parts of two frames
    }
  }
}

TEST_CASE("frames of 24 channels that lack eleven characters are no stretched frames, while others are whole") {
  // Their header, flags and end stay; the silence is too short to end a frame.
  const Bytes first = part(neutralFrame(1), 0, 12), last = part(neutralFrame(1), 12);
  const Bytes inside(11, 0x55);
  for (const unsigned lacking : {1u, 2u, 3u}) {  // in a row
    CAPTURE(lacking);
    Line line;
    line.finder.reset(line.now, Line::CharacterUs, 0);
    Frames found;
    const auto send = [&](uint32_t silentUs, const Bytes &bytes) {
      found = found + line.wait(silentUs).waited;
      found = found + line.feed(bytes);
    };
    line.settle();
    for (unsigned times = 0; times < 10; times++) {
      send(WideUs, first + inside + last);
      for (unsigned i = 0; i < lacking; i++) {
        send(WideUs, first);
        send(11 * Line::CharacterUs, last);
      }
    }
    CHECK(found.empty());
  }
}
