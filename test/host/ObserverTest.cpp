// An Observer shows every character of a line once, each frame in its place, and the line's statistics.
#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "line/Examination.h"
#include "line/simulation/NoisyLine.h"
#include "line/simulation/SimulatedReceiver.h"
#include "support/KnownFrames.h"
#include "support/Watched.h"

TEST_CASE("frames have their bytes, times, channels, rate and gaps") {
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

TEST_CASE("the shortest and longest gap are kept; resetMarks() clears the marks") {
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

TEST_CASE("the link has its state and quality; frames with a flag are shown, but leave no marks") {
  Watched line;
  CHECK(line.observer.state(0) == sbus::LinkState::NeverSeen);
  CHECK(line.observer.linkQuality(0) == 0);
  line.frame(992);
  CHECK(line.observer.state(line.us) == sbus::LinkState::Ok);
  CHECK(line.observer.linkQuality(line.us) == 100);
  CHECK(line.observer.linkQuality(line.observer.newest().endUs + 99999) == 100);
  CHECK(line.observer.linkQuality(line.observer.newest().endUs + 100000) == 0);
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

TEST_CASE("FASSTest 26: if a line is joined at a frame with header 2F, that frame counts, and so does the last one") {
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
      {"alone", {extra}, 0, 0, 3},  // its payload has a header, of which the decoder expects more
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

TEST_CASE("FASSTest 26: a frame with header 2F that comes first after a silence counts, and doctor finds no noise") {
  Bytes extra = Watched::frameOf(500);
  extra[0] = sbus::ExtraHeader;
  const Bytes frame = Watched::frameOf(992);
  for (const uint64_t silenceUs : {uint64_t{4000}, uint64_t{49000}, uint64_t{60000}, uint64_t{500000}}) {
    INFO("silence of ", silenceUs, " us");
    Watched line;
    line::Examination examination;
    examination.begin(line.observer, 0);
    for (unsigned pair = 0; pair < 300; pair++) {
      line.us += pair % 30 == 7 ? silenceUs : 4000;
      line.send(extra);
      line.us += 4000;
      line.send(frame);
    }
    line.observer.finish();
    CHECK(line.observer.counters().frames == 300);
    CHECK(line.observer.counters().extraFrames == 300);
    CHECK(line.observer.counters().discardedBytes == 0);
    CHECK(line.frames() == 600);
    sbus::Diagnosis diagnosis;
    diagnosis.add(examination.trial(line.observer, line::LineSettings(), line.us));
    CHECK(diagnosis.finding() == sbus::Finding::AllWell);
  }
}

TEST_CASE(
    "a line has 32 channels once two frames with header 2F come within 8 others; the first on a line counts for the "
    "next") {
  const struct {
    const char *line;    // x: with header 2F
    const char *counts;  // of channels after each frame: 3 for 32, 1 for 16
  } rows[] = {
      {"ffffxffffffffffff", "1111111111111111"},
      {"ffxfffffffxfff", "111111111333"},
      {"ffxffffffffxfff", "1111111111111"},
      {"xffffxffffffff", "311133333333"},
      {"xffffffffff", "3111111111"},
      {"xfxfxf", "333"},
      {"fxfxfxf", "1133"},
      {"fxfxffffffffffff", "11333333333333"},
  };
  for (const auto &row : rows) {
    CAPTURE(row.line);
    Watched line;
    std::string counts;
    line.observer.listen([&](const Stretch &stretch) {
      if (stretch.kind == Stretch::Kind::Frame) {
        counts += line.observer.newest().count == 32 ? '3' : '1';
        CHECK(line.observer.travel(20).count == static_cast<uint64_t>(std::count(counts.begin(), counts.end(), '3')));
      }
    });
    for (const char *kind = row.line; *kind != '\0'; kind++) {
      Bytes frame = Watched::frameOf(992);
      frame[0] = *kind == 'x' ? sbus::ExtraHeader : frame[0];
      line.us += 4000;
      line.send(frame);
    }
    line.observer.finish();
    CHECK(counts == row.counts);
  }
}

TEST_CASE("a sender's faults are named from its characters' errors: no parity, and a wrong idle level; not noise") {
  const struct {
    const char *what;
    unsigned good;       // characters before each break
    bool isBreak;        // one that ends in the line's wrong idle level
    uint64_t silenceUs;  // after that
    unsigned times;
    sbus::Finding fault;
  } rows[] = {
      {"a break before each silence", 12, true, 5000, 5, sbus::Finding::IdleLevel},
      {"too few good characters, as with the wrong polarity", 11, true, 5000, 50, sbus::Finding::NoSignal},
      {"too few breaks", 12, true, 5000, 3, sbus::Finding::NoSignal},
      {"breaks without silence", 12, true, 1000, 50, sbus::Finding::NoSignal},
      {"00 with a good stop bit", 12, false, 5000, 50, sbus::Finding::NoSignal},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    line::SenderFaults faults;
    uint64_t us = 0;
    const auto put = [&](uint8_t value, bool bad) {
      Character character;
      character.endUs = us += 120;
      character.value = value;
      character.bad = bad;
      faults.put(character);
    };
    for (unsigned i = 0; i < row.times; i++) {
      put(0xB0, true);
      for (unsigned k = 0; k < row.good; k++) {
        put(0x0F, false);
      }
      put(0, row.isBreak);
      us += row.silenceUs;
    }
    CHECK(faults.found() == row.fault);
    for (unsigned i = 0; i < 20; i++) {
      put(0x0F, true);
      put(i == 19 ? 0x0F : 0x07, i == 19);
    }
    CHECK(faults.found() == row.fault);
    put(0x07, false);
    CHECK(faults.found() == sbus::Finding::NoParity);
    put(0x03, false);
    CHECK(faults.found() == row.fault);
  }
}

TEST_CASE("seven data bits: of 1000 characters each bit has come but bit 7") {
  const struct {
    const char *what;
    unsigned count;
    uint8_t bits, last;
    sbus::Finding fault;
  } rows[] = {
      {"1000", 1000, 0x7F, 0x0F, sbus::Finding::SevenBits},
      {"999", 999, 0x7F, 0x0F, sbus::Finding::NoSignal},
      {"the last has bit 7", 1000, 0x7F, 0x80, sbus::Finding::NoSignal},
      {"all channels are 0", 1000, 0x0F, 0x00, sbus::Finding::NoSignal},
      {"bit 6 is missing", 1000, 0x3F, 0x0F, sbus::Finding::NoSignal},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    line::SenderFaults faults;
    Character character;
    for (unsigned i = 1; i <= row.count; i++) {
      character.endUs += 120;
      character.value = i == row.count ? row.last : static_cast<uint8_t>(i & row.bits);
      faults.put(character);
    }
    CHECK(faults.found() == row.fault);
  }
}

TEST_CASE("packets of one length are described: what a frame has, and their period") {
  const struct {
    Bytes packet;
    const char *text;
  } rows[] = {
      {Bytes(24, 0x0F), "Packets: 24 bytes from 0F to 0F, one every 9.0 ms; a frame has 25 bytes."},
      {Bytes(25, 0x0F), "Packets: 25 bytes from 0F to 0F, one every 9.0 ms; a frame ends with 00."},
      {Bytes{0xF0} + Bytes(24, 0x00),
       "Packets: 25 bytes from F0 to 00, one every 9.0 ms; a frame begins with 0F: the lowest bit of a byte is sent "
       "first."},
      {Bytes{0x55} + Bytes(7, 0x06),
       "Packets: 8 bytes from 55 to 06, one every 9.0 ms; a frame has 25 bytes; a frame begins with 0F."},
      {Bytes{0x0F} + Bytes(22, 0x00) + Bytes{0x31, 0x00},
       "Packets: 25 bytes from 0F to 00, one every 9.0 ms; the flags are 31, where a frame has 0 in bits 4 to 7."},
      {Bytes{0x0F} + Bytes(24, 0x00), ""},
  };
  for (const auto &row : rows) {
    CAPTURE(row.text);
    line::Observer observer;
    for (unsigned i = 0; i < 30; i++) {
      for (size_t at = 0; at < row.packet.size(); at++) {
        Character character;
        character.endUs = 9000 * (i + 1) + 120 * at;
        character.value = row.packet[at];
        observer.put(character);
      }
    }
    CHECK(observer.packets() == row.text);
  }
}

TEST_CASE("FASSTest 26: a frame with header 2F that ended before the link's state was last read does not change it") {
  Watched line;
  line.frame(992);
  Bytes extra = Watched::frameOf(500);
  extra[0] = sbus::ExtraHeader;
  line.send(extra);
  const size_t before = line.frames();
  CHECK(line.observer.state(line.us + 5000) == sbus::LinkState::Ok);
  line.observer.finish();
  CHECK(line.frames() == before + 1);
  CHECK(line.observer.state(line.us + 5000) == sbus::LinkState::Ok);
  CHECK(line.observer.linkQuality(line.us + 5000) == 100);
}

TEST_CASE("a frame in sync is handed over with its last character, not only once the line is silent") {
  Watched line;
  line.frame(992).frame(1000);
  for (size_t number = 3; number < 50; number++) {
    line.send(Watched::frameOf(992)).gap(0);
    REQUIRE(line.stretches.size() == number);
    CHECK(line.stretches.back().isFrame());
    line.gap(PeriodUs - 3000);
  }
}

TEST_CASE("telemetry is handed over at the next gap, not only with the next frame") {
  Watched line;
  line.frame(992).frame(1000).frame(992).send({0x03, 0xC0, 0x2E}).gap(2000);
  REQUIRE(line.stretches.size() == 4);
  CHECK(line.stretches[3].characters.size() == 3);
}

TEST_CASE("of the simulated receivers every frame is found, and each character once, in order") {
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

TEST_CASE("a noisy line: each rejection stands at a header, and no frame has a character with an error") {
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
        REQUIRE(sbus::isHeaderByte<sbus::Frame16Extra>(stretch.characters.at(header.at).value));
        REQUIRE_FALSE(stretch.characters[header.at].bad);
        rejected++;
      }
      REQUIRE((!stretch.isFrame() || std::none_of(stretch.characters.begin(), stretch.characters.end(),
                                                  [](const Character &character) { return character.bad; })));
    }
    CHECK(at == watched.observer.characters());
    CHECK(watched.observer.characterErrors() > 500);
    CHECK(rejected > 100);
  }
}
