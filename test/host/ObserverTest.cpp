// What a person is shown of a line: every character once, each frame where it stood, and the numbers beside it.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "line/Observer.h"
#include "line/simulation/NoisyLine.h"
#include "line/simulation/SimulatedReceiver.h"
#include "support/Bytes.h"
#include "support/KnownFrames.h"

using line::Character;
using line::Observer;
using line::Stretch;

namespace {

constexpr uint64_t PeriodUs = 9000;

// A line, and what its observer said of it.
struct Watched {
  Observer observer;
  std::vector<Stretch> stretches;
  uint64_t us = 0;

  explicit Watched(uint32_t characterUs = line::CharacterUs) : _characterUs(characterUs) {
    observer.reset(0, characterUs);
    observer.listen([this](const Stretch &stretch) { stretches.push_back(stretch); });
  }

  Watched &send(const Bytes &bytes, size_t bad = SIZE_MAX) {
    for (size_t i = 0; i < bytes.size(); i++) {
      us += _characterUs;
      Character character;
      character.endUs = us;
      character.value = bytes[i];
      character.bad = i == bad;
      observer.put(character);
    }
    return *this;
  }

  Watched &gap(uint64_t gapUs) {
    us += gapUs;
    observer.idleUntil(us);
    return *this;
  }

  // A frame of 16 channels, each `value`, and the gap to the next.
  Watched &frame(uint16_t value, bool failsafe = false, bool lostFrame = false, uint64_t periodUs = PeriodUs) {
    return send(frameOf(value, failsafe, lostFrame)).gap(periodUs - 25 * _characterUs);
  }

  static Bytes frameOf(uint16_t value, bool failsafe = false, bool lostFrame = false) {
    uint16_t channels[sbus::ChannelCount];
    std::fill_n(channels, sbus::ChannelCount, value);
    channels[16] = 1;
    channels[17] = 0;
    Bytes bytes(sbus::FrameSize);
    sbus::pack(bytes.data(), channels, failsafe, lostFrame);
    return bytes;
  }

  size_t frames() const {
    return static_cast<size_t>(
        std::count_if(stretches.begin(), stretches.end(), [](const Stretch &stretch) { return stretch.isFrame(); }));
  }

 private:
  uint32_t _characterUs;
};

Bytes bytesOf(const Stretch &stretch) {
  Bytes bytes;
  for (const Character &character : stretch.characters) {
    bytes.push_back(character.value);
  }
  return bytes;
}

}  // namespace

TEST_CASE("frames: bytes, time, channels, rate and gaps") {
  Watched line;
  for (unsigned number = 0; number < 200; number++) {
    line.frame(static_cast<uint16_t>(1000 + number));
  }
  REQUIRE(line.stretches.size() == 200);
  CHECK(bytesOf(line.stretches[7]) == Watched::frameOf(1007));
  CHECK(line.stretches[7].endUs() == 7 * PeriodUs + 25 * 120);
  CHECK(why(line.stretches[7]).empty());
  CHECK(line.observer.newest().endUs == 199 * PeriodUs + 3000);
  CHECK(line.observer.newest().count == 16);
  CHECK(line.observer.newest().raw[15] == 1199);
  CHECK(line.observer.newest().switches[0]);
  CHECK_FALSE(line.observer.newest().switches[1]);
  CHECK(line.observer.gaps().count == 199);
  CHECK(line.observer.gaps().low == PeriodUs);
  CHECK(line.observer.gaps().mean() == PeriodUs);
  CHECK(line.observer.gaps().high == PeriodUs);
  CHECK(line.observer.travel(3).low == 1000);
  CHECK(line.observer.travel(3).high == 1199);
  CHECK(line.observer.perSecond(line.us) == 111);
  CHECK(line.observer.perSecond(line.us + 500000) == 55);
  CHECK(line.observer.perSecond(line.us + 1000000) == 0);
  CHECK(line.observer.ageUs(line.us) == 6000);
  CHECK(line.observer.characters() == 5000);
}

TEST_CASE("gaps differ; marks begin anew") {
  Watched line;
  line.frame(992).frame(172, false, false, 12000).frame(1811).frame(992);
  CHECK(line.observer.gaps().low == 9000);
  CHECK(line.observer.gaps().mean() == 10000);
  CHECK(line.observer.gaps().high == 12000);
  line.observer.resetMarks();
  CHECK(line.observer.gaps().count == 0);
  line.frame(1000);
  CHECK(line.observer.gaps().high == 9000);
  CHECK(line.observer.travel(0).low == 1000);
}

TEST_CASE("the link: its state, and the flags of frames that are shown but leave no marks") {
  Watched line;
  CHECK(line.observer.state(0) == sbus::LinkState::NeverSeen);
  line.frame(992);
  CHECK(line.observer.state(line.us) == sbus::LinkState::Ok);
  line.frame(500, false, true);
  CHECK(line.observer.state(line.us) == sbus::LinkState::Lossy);
  CHECK(line.observer.newest().lostFrame);
  line.frame(172, true, true);
  CHECK(line.observer.state(line.us) == sbus::LinkState::Failsafe);
  CHECK(line.observer.newest().raw[0] == 172);
  CHECK(line.observer.travel(0).low == 992);
  CHECK(line.observer.travel(0).count == 1);
  CHECK(line.observer.state(line.observer.newest().endUs + 99999) == sbus::LinkState::Failsafe);
  CHECK(line.observer.state(line.observer.newest().endUs + 100000) == sbus::LinkState::Stale);
  CHECK(line.observer.ageUs(line.observer.newest().endUs + 5000000000) == 5000000000);
}

TEST_CASE("what is no frame stands between the frames, with the reason") {
  const Bytes good = Watched::frameOf(992);
  Bytes shortened = good;
  shortened.erase(shortened.begin() + 5);
  Bytes flags = good;
  flags[23] = 0x40;
  const struct {
    const char *what;
    Bytes bytes;
    size_t bad;
    const char *reason;
  } cases[] = {
      {"telemetry", {0x03, 0xC0, 0x2E}, SIZE_MAX, "no header"},
      {"a bad character in a frame", good, 9, "parity or framing error (byte 9)"},
      {"its header", good, 0, "parity or framing error (byte 0)"},
      {"its end byte", good, 24, "parity or framing error (byte 24)"},
      {"a byte is missing", shortened, SIZE_MAX, "no end byte"},
      {"unused flags", flags, SIZE_MAX, "unused flags set, no end byte (byte 10)"},
      {"one bad character", {0x55}, 0, "parity or framing error"},
  };
  for (const auto &each : cases) {
    CAPTURE(each.what);
    Watched line;
    line.frame(992).frame(1000).frame(992);
    line.send(each.bytes, each.bad).gap(4000);
    line.frame(1000).frame(992);
    line.observer.finish();
    REQUIRE(line.stretches.size() == 6);
    const Stretch &stretch = line.stretches[3];
    CHECK(stretch.kind == Stretch::Kind::NoFrame);
    CHECK(bytesOf(stretch) == each.bytes);
    CHECK(why(stretch) == each.reason);
    CHECK(line.frames() == 5);
    CHECK(line.observer.counters().frames == 5);
  }
}

TEST_CASE("the reason names its cause, and the header that it was found at") {
  const Bytes good = Watched::frameOf(1024);
  const Bytes failsafe = bytesOf(FailsafeFrame);
  const Bytes noise = {0x55, 0x55};
  const struct {
    const char *what;
    std::vector<Bytes> groups;  // eight characters of silence between them
    const char *reasons;        // of all stretches
  } rows[] = {
      {"a gap", {good, part(good, 0, 12), part(good, 12), good}, "frame | a gap inside | no header | frame"},
      {"behind noise", {good, noise + part(good, 0, 12), part(good, 12)}, "frame | a gap inside (byte 2) | no header"},
      {"more follow", {good + noise + noise, good}, "more bytes than a frame | no header | frame"},
      {"no gap",
       {noise, noise + good + good, good},
       "no header | not at a gap (byte 2) | no header | frame | frame"},
      {"halves",
       {Bytes(40, 0x55) + part(failsafe, 8) + failsafe, good},
       "no header | no end byte (byte 15) | may be the halves of two frames (byte 5) | frame | frame"},
      {"neither", {good, noise + failsafe, good}, "frame | no header | frame | frame"},
  };
  for (const auto &row : rows) {
    INFO(std::string(row.what));
    Watched line;
    for (const Bytes &bytes : row.groups) {
      line.send(bytes).gap(8 * line::CharacterUs);
    }
    line.gap(PeriodUs).observer.finish();
    std::string reasons;
    for (const Stretch &stretch : line.stretches) {
      reasons += (reasons.empty() ? "" : " | ") + (stretch.isFrame() ? "frame" : why(stretch));
    }
    CHECK(reasons == std::string(row.reasons));
  }
}

TEST_CASE("what is wrong with a bad character is named with its place, as far as its source tells") {
  struct Bad {
    size_t at;
    bool parity, stop;
  };
  const struct {
    std::vector<Bad> bad;
    const char *reason;
  } rows[] = {
      {{{3, true, false}}, "parity error (byte 3)"},
      {{{0, false, true}}, "framing error (byte 0)"},
      {{{24, true, true}}, "parity and framing error (byte 24)"},
      {{{2, false, false}}, "parity or framing error (byte 2)"},
      {{{3, false, true}, {2, true, false}, {9, true, false}}, "2 parity errors (bytes 2, 9), framing error (byte 3)"},
      {{{1, true, false}, {2, true, false}, {3, true, false}, {4, true, false}}, "4 parity errors"},
  };
  for (const auto &row : rows) {
    Stretch stretch;
    stretch.characters.resize(25);
    for (const Bad &bad : row.bad) {
      stretch.characters[bad.at] = {0, 0x0F, true, 0, bad.parity, bad.stop};
    }
    CHECK(why(stretch) == row.reason);
    stretch.rejected.push_back({5, sbus::Rejection::NoEnd});
    CHECK(why(stretch) == row.reason);
  }
}

TEST_CASE("a gap of eight characters within a frame is seen, one of seven is not") {
  for (const uint32_t characterUs : {120u, 60u}) {
    CAPTURE(characterUs);
    for (const uint32_t characters : {7u, 8u}) {
      Watched line(characterUs);
      line.frame(992).send(part(Watched::frameOf(1000), 0, 9)).gap(characters * characterUs);
      line.send(part(Watched::frameOf(1000), 9)).gap(PeriodUs).frame(992);
      CHECK(line.frames() == (characters == 7 ? 3 : 2));
      CHECK(line.observer.counters().rejectedByLength == (characters == 7 ? 0 : 1));
    }
  }
}

TEST_CASE("FASSTest 26: the frame with header 2F at which a line is joined is one, and so is the last one") {
  Bytes extra = Watched::frameOf(500);
  extra[0] = sbus::ExtraHeader;
  const Bytes frame = Watched::frameOf(992);
  const Bytes noise = {0x55};
  const struct {
    const char *what;
    std::vector<Bytes> groups;  // 1 ms of silence between them, none at the end
    size_t frames, extra, skipped;
  } rows[] = {
      {"a pair", {extra, frame}, 1, 1, 0},
      {"a pair and a half", {extra, frame, extra}, 1, 2, 0},
      {"two pairs", {extra, frame, extra, frame}, 2, 2, 0},
      {"joined in the middle of one", {part(extra, 9), frame, extra, frame, extra}, 2, 2, 16},
      {"joined in the middle of the one before", {part(frame, 9), extra, frame, extra}, 1, 2, 16},
      {"alone", {extra}, 0, 0, 3},  // its payload has a header: the decoder waits for more of that
      {"noise straight before it", {noise + extra, frame}, 1, 0, 26},
      {"noise behind it", {extra, noise, frame}, 1, 0, 26},
      {"cut off", {extra, part(frame, 0, 24)}, 0, 0, 25},
      {"one frame", {frame}, 1, 0, 0},
  };
  for (const auto &row : rows) {
    INFO(std::string(row.what));
    Watched line;
    for (size_t i = 0; i < row.groups.size(); i++) {
      line.us += i == 0 ? 0 : 1000;
      line.send(row.groups[i]);
    }
    line.observer.finish();
    CHECK(line.observer.counters().frames == row.frames);
    CHECK(line.observer.counters().extraFrames == row.extra);
    CHECK(line.observer.counters().discardedBytes == row.skipped);
    CHECK(line.frames() == row.frames + row.extra);
    size_t at = 0;
    for (const Stretch &stretch : line.stretches) {
      CHECK(stretch.at == at);
      at += stretch.characters.size();
    }
    CHECK(at == line.observer.characters());
  }
}

TEST_CASE("telemetry is told at the next gap, not with the next frame") {
  Watched line;
  line.frame(992).frame(1000).frame(992).send({0x03, 0xC0, 0x2E}).gap(2000);
  REQUIRE(line.stretches.size() == 4);
  CHECK(line.stretches[3].characters.size() == 3);
}

TEST_CASE("a frame that has lost a character to an error and got another at its end is none, though a decoder takes it") {
  for (const size_t bad : {size_t{1}, size_t{3}, size_t{22}}) {
    CAPTURE(bad);
    Watched line;
    for (int i = 0; i < 5; i++) {
      line.frame(992);
    }
    Bytes bytes = Watched::frameOf(1000);
    bytes.push_back(0x00);
    line.send(bytes, bad).gap(PeriodUs);
    CHECK(line.observer.counters().frames == 6);
    CHECK(line.frames() == 5);
    CHECK(line.observer.newest().raw[0] == 992);
    CHECK(line.observer.newest().endUs == 4 * PeriodUs + 3000);
    REQUIRE(line.stretches.size() == 6);
    CHECK(bytesOf(line.stretches[5]) == bytes);
    CHECK(why(line.stretches[5]) == "parity or framing error (byte " + std::to_string(bad) + ")");
    CHECK(line.observer.badCharacters() == 1);
    line.frame(1001);
    CHECK(line.frames() == 6);
    CHECK(line.observer.newest().raw[15] == 1001);
  }
}

TEST_CASE("bad characters only: they are all told, and none is kept for long") {
  Watched line;
  for (unsigned i = 0; i < 1000; i++) {
    line.send({static_cast<uint8_t>(i)}, 0);
  }
  CHECK(line.stretches.size() >= 29);
  line.observer.finish();
  size_t told = 0;
  for (const Stretch &stretch : line.stretches) {
    told += stretch.characters.size();
    CHECK(stretch.characters.size() <= 25);
  }
  CHECK(told == 1000);
}

TEST_CASE("the simulated receivers: each character once, in its order, and every frame") {
  const struct {
    line::Channels channels;
    unsigned count;
    Stretch::Kind kind;
    size_t frames;
    size_t extra;
    uint64_t gapUs;
  } cases[] = {
      {line::Channels::Sixteen, 16, Stretch::Kind::Frame, 110, 0, 9000},
      {line::Channels::TwentyFour, 24, Stretch::Kind::Frame24, 110, 0, 9000},
      {line::Channels::ThirtyTwo, 32, Stretch::Kind::Frame, 55, 55, 18000},
  };
  for (const auto &each : cases) {
    CAPTURE(each.count);
    for (const uint32_t characterUs : {120u, 60u}) {
      CAPTURE(characterUs);
      line::SimulatedReceiver receiver(line::Flight, characterUs, each.channels);
      Watched watched(characterUs);
      std::vector<Character> sent;
      for (Character character; receiver.next(1000000, character);) {
        watched.observer.put(character);
        sent.push_back(character);
      }
      watched.observer.finish();
      CHECK(watched.observer.newest().count == each.count);
      CHECK(watched.observer.has24() == (each.count == 24));
      CHECK(watched.observer.gaps().low == each.gapUs);
      CHECK(watched.observer.gaps().high == each.gapUs);
      size_t at = 0;
      size_t frames = 0;
      size_t extra = 0;
      for (const Stretch &stretch : watched.stretches) {
        frames += stretch.kind == each.kind;
        extra += stretch.kind == Stretch::Kind::Extra;
        REQUIRE(stretch.at == at);
        for (const Character &character : stretch.characters) {
          REQUIRE(at < sent.size());
          REQUIRE(character.endUs == sent[at].endUs);
          REQUIRE(character.value == sent[at++].value);
        }
      }
      CHECK(at == sent.size());
      CHECK(frames >= each.frames);  // the second's last one may be cut off
      CHECK(frames <= each.frames + 1);
      CHECK(extra >= each.extra);
      CHECK(extra <= each.extra + 1);
    }
  }
}

TEST_CASE("a noisy line: each rejection stands at a header, and no frame has a bad character") {
  for (const auto channels : {line::Channels::Sixteen, line::Channels::TwentyFour, line::Channels::ThirtyTwo}) {
    CAPTURE(channels);
    line::NoisyLine noisy(std::make_unique<line::SimulatedReceiver>(line::Flight, 120, channels), 100, 120);
    Watched watched;
    for (Character character; noisy.next(10000000, character);) {
      watched.observer.put(character);
    }
    watched.observer.finish();
    uint64_t at = 0;
    size_t rejected = 0;
    for (const Stretch &stretch : watched.stretches) {
      REQUIRE(stretch.at == at);
      at += stretch.characters.size();
      for (const line::Rejected &header : stretch.rejected) {
        REQUIRE(sbus::isHeaderByte<sbus::Frame16>(stretch.characters.at(header.at).value));
        REQUIRE_FALSE(stretch.characters[header.at].bad);
        rejected++;
      }
      REQUIRE((!stretch.isFrame() || std::none_of(stretch.characters.begin(), stretch.characters.end(),
                                                  [](const Character &character) { return character.bad; })));
    }
    CHECK(at == watched.observer.characters());
    CHECK(watched.observer.badCharacters() > 500);
    CHECK(rejected > 100);
  }
}
