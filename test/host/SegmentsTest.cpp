// The stretches of a line that are no frames: where they are, and why.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "support/KnownFrames.h"
#include "support/Watched.h"

TEST_CASE("characters that belong to no frame are shown between the frames, with the reason") {
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
      {"a character with an error in a frame", good, 9, "parity or framing error (byte 9)"},
      {"its header", good, 0, "parity or framing error (byte 0)"},
      {"its end byte", good, 24, "parity or framing error (byte 24)"},
      {"a byte is missing", shortened, SIZE_MAX, "a gap inside"},
      {"unused flags", flags, SIZE_MAX, "unused flags set"},
      {"one character, with an error", {0x55}, 0, "parity or framing error"},
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

TEST_CASE("the reason names its cause, and the place of the header") {
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
      {"no gap", {noise, noise + good + good, good}, "no header | not at a gap (byte 2) | no header | frame | frame"},
      {"a false sync",
       {Bytes(40, 0x55) + part(failsafe, 8) + failsafe, good},
       "no header | no end byte (byte 15) | may be a false sync (byte 5) | frame | frame"},
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

TEST_CASE("a character error is named with its place, and with its kind if its source tells") {
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

TEST_CASE("a gap of eight characters within a frame is seen, a gap of seven is not") {
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

TEST_CASE(
    "a frame that lost a character to an error, with another after it, is none and not counted, though its size fits") {
  for (const size_t bad : {size_t{1}, size_t{3}, size_t{22}}) {
    CAPTURE(bad);
    Watched line;
    for (int i = 0; i < 5; i++) {
      line.frame(992);
    }
    Bytes bytes = Watched::frameOf(1000);
    bytes.push_back(0x00);
    line.send(bytes, bad).gap(PeriodUs);
    CHECK(line.observer.counters().frames == 5);
    CHECK(line.observer.counters().discardedBytes == 25);
    CHECK(line.frames() == 5);
    CHECK(line.observer.newest().raw[0] == 992);
    CHECK(line.observer.newest().endUs == 4 * PeriodUs + 3000);
    REQUIRE(line.stretches.size() == 6);
    CHECK(bytesOf(line.stretches[5]) == bytes);
    CHECK(why(line.stretches[5]) == "parity or framing error (byte " + std::to_string(bad) + ")");
    CHECK(line.observer.characterErrors() == 1);
    line.frame(1001);
    CHECK(line.frames() == 6);
    CHECK(line.observer.newest().raw[15] == 1001);
  }
}

TEST_CASE("a line on which each character has an error: all are handed over, and none is kept for long") {
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
