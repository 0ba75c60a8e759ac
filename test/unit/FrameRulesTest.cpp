// When 25 characters are a frame: each rule by itself, and all of them together.
#include <doctest/doctest.h>

#include <string>

#include "support/Candidates.h"
#include "support/ShowArrays.h"

using namespace sbus;

TEST_CASE("flags: the upper four bits are 0") {
  for (unsigned byte = 0; byte < 256; byte++) {
    CHECK(rules::areFlags(static_cast<uint8_t>(byte)) == (byte < 16));
  }
}

TEST_CASE(
    "inside: a gap before the second to the last character rejects, up to that gap; where the sender may have "
    "stretched the frame, another gap is waited for") {
  for (int gapAt = -3; gapAt < 30; gapAt++) {
    CAPTURE(gapAt);
    const bool isInside = gapAt > 0 && gapAt < 25;
    const std::string rejected = "gap inside " + std::to_string(gapAt);
    const Bytes followed = Plain + Bytes{0x55};
    constexpr Silence None = Silence::Unknown;
    const struct {
      const char *what;
      Case given;
      std::string inside;  // the verdict if the gap lies inside
    } rows[] = {
        {"in sync", {Plain, gapAt}, "wait"},
        {"... if the gap is only likely", {Plain, gapAt, 0, true, true, false}, "wait"},
        {"... if the gap is wide", {Plain, gapAt, 0, true, true, true, None, false, true}, rejected},
        {"... if a wide gap lies before it", {Plain, gapAt, 0, true, true, true, Silence::Wide}, rejected},
        {"... if no gap has followed", {followed, gapAt}, rejected},
        {"out of sync", {Plain, gapAt, 1}, rejected},
        {"... after a wide gap", {Plain, gapAt, 1, false, true, true, None, true}, "wait"},
        {"... and the variant is unknown", {Plain, gapAt, 1, false, false, true, None, true}, "wait"},
    };
    for (const auto &row : rows) {
      CAPTURE(row.what);
      const bool hasOther = row.given.inside != None;
      CHECK(rules::hasGapInside(row.given.candidate()) == (isInside || hasOther));
      if (isInside) {
        CHECK(judged(row.given, stretching()) == row.inside);
        CHECK(judged(row.given) == row.inside);
      }
    }
  }
}

TEST_CASE(
    "inside: with a gap after it, a frame with gaps inside is one if its sender stretches frames, and all is in place") {
  constexpr Silence Gap = Silence::Gap;
  const struct {
    const char *what;
    Case given;
    const char *stretching, *first;  // verdict, and that while the line is not known to stretch frames
  } rows[] = {
      {"in sync", {Plain, 25, 0, true, true, true, Gap}, "aligned", "gap inside 25"},
      {"... a wide gap after it", {Plain, 25, 0, true, true, true, Gap, false, true}, "aligned", "gap inside 25"},
      {"... a likely gap after it", {Plain, 25, 0, true, true, false, Gap}, "wait", "wait"},
      {"... a likely gap inside", {Plain, 25, 0, true, true, true, Silence::Likely}, "gap inside 25", "gap inside 25"},
      {"... a wide gap inside", {Plain, 25, 0, true, true, true, Silence::Wide}, "gap inside 25", "gap inside 25"},
      {"... a gap one later", {Plain + Bytes{0x55}, 26, 0, true, true, true, Gap}, "gap inside 25", "gap inside 25"},
      {"out of sync", {Plain, 25, 1, false, true, true, Gap}, "gap inside 25", "gap inside 25"},
      {"... after a wide gap", {Plain, 25, 1, false, true, true, Gap, true}, "aligned", "gap inside 25"},
      {"variant unknown, a gap after it", {Plain, 25, 1, false, false, true, Gap, true}, "wait", "wait"},
      {"... one more character", {Plain + Bytes{0x0F}, 25, 1, false, false, true, Gap, true}, "gap inside 25",
       "gap inside 25"},
      {"... a wide gap after it", {Plain, 25, 1, false, false, true, Gap, true, true}, "aligned", "gap inside 25"},
      {"... and none before it", {Plain, 25, 1, false, false, true, Gap, false, true}, "gap inside 25", "gap inside 25"},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    CHECK(judged(row.given, stretching()) == row.stretching);
    CHECK(judged(row.given) == row.first);
  }
}

TEST_CASE(
    "inside: two stretched frames with at most two others in between show a sender that stretches, for a hundred") {
  const auto whole = [](FrameSizeCheck<Frame16> &acquisition) {
    acquisition.gap(0, false);
    acquisition.characters(25);
    acquisition.gap(0, false);
  };
  for (unsigned between = 0; between < 5; between++) {
    CAPTURE(between);
    FrameSizeCheck<Frame16> acquisition = noneSeen();
    acquisition.stretchedFrame();
    CHECK_FALSE(acquisition.isStretched());
    for (unsigned frame = 0; frame < between; frame++) {
      whole(acquisition);
    }
    acquisition.stretchedFrame();
    CHECK(acquisition.isStretched() == (between <= 2));
  }
  FrameSizeCheck<Frame16> acquisition = stretching();
  for (unsigned frame = 0; frame < 99; frame++) {
    whole(acquisition);
  }
  FrameSizeCheck<Frame16> late = acquisition;
  late.stretchedFrame();
  CHECK(late.isStretched());
  whole(acquisition);
  acquisition.stretchedFrame();
  CHECK_FALSE(acquisition.isStretched());
}

TEST_CASE("variant, tail, 2F: what must follow a frame, on a line of its variant, and before the first frame") {
  const Bytes s2 = bytesOf(plainFrame(1, 0x14)), tailed = bytesOf(plainFrame(1, 0x08)) + tailOf(0x08);
  const struct {
    const char *what;
    Bytes bytes;
    int gapAt;
    const char *known, *unknown;
  } rows[] = {
      {"nothing yet", Plain, Far, "aligned", "wait"},
      {"a header", Plain + Bytes{0x0F}, Far, "aligned", "aligned"},
      {"2F", Plain + Bytes{0x2F}, Far, "aligned", "aligned"},
      {"a gap", Plain, 25, "aligned", "aligned"},
      {"a gap, then anything", Plain + Bytes{0x55}, 25, "aligned", "aligned"},
      {"something else", Plain + Bytes{0x55}, Far, "aligned", "wait"},
      {"something else, and one more", Plain + Bytes{0x55, 0x0F}, Far, "aligned", "goes on 2"},
      {"a tail's beginning", part(tailed, 0, 29), Far, "aligned", "wait"},
      {"the tail", tailed, Far, "aligned", "wait"},
      {"the tail and a header", tailed + Bytes{0x0F}, Far, "aligned", "aligned"},
      {"the tail and 2F, which such a line does not have", tailed + Bytes{0x2F, 0x55}, Far, "aligned", "goes on 2"},
      {"a gap within the tail", part(tailed, 0, 27), 27, "aligned", "aligned"},
      {"the ID of a slot, the first time", s2 + Bytes{0x13, 0xC0}, Far, "aligned", "goes on 2"},
      {"no ID", s2 + Bytes{0x15, 0xC0}, Far, "aligned", "goes on 2"},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    CHECK(judged({row.bytes, row.gapAt}) == row.known);
    CHECK(judged({row.bytes, row.gapAt, 0, true, false}) == row.unknown);
  }
}

TEST_CASE(
    "2F: extra channels are accepted on a line of known variant, in their place or at a gap, before a gap or a "
    "header") {
  const Bytes extra = bytesOf(withByte(plainFrame(1), 0, ExtraHeader));
  const struct {
    const char *what;
    Bytes bytes;
    int gapAt, offBy;
    bool hasLineVariant;
    const char *verdict;
  } rows[] = {
      {"in its place, a header follows", extra + Bytes{0x0F}, Far, 0, true, "aligned"},
      {"... 2F follows", extra + Bytes{0x2F}, Far, 0, true, "aligned"},
      {"... a gap follows", extra, 25, 0, true, "aligned"},
      {"... nothing follows yet", extra, Far, 0, true, "wait"},
      {"... anything follows", extra + Bytes{0x55}, Far, 0, true, "goes on 1"},
      {"elsewhere, a header follows", extra + Bytes{0x0F}, Far, 1, true, "not at gap 1"},
      {"... a gap follows", extra, 25, 1, true, "aligned"},
      {"... after a gap", extra + Bytes{0x0F}, 0, 1, true, "aligned"},
      {"a gap within", extra + Bytes{0x0F}, 24, 0, true, "gap inside 24"},
      {"a line of another variant, or unknown", extra + Bytes{0x0F}, 0, 0, false, "not at gap 1"},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    CHECK(judged<Frame16Extra>({row.bytes, row.gapAt, row.offBy, true, row.hasLineVariant}) == row.verdict);
  }
}

TEST_CASE(
    "slots: on an S.BUS2 line a slot's ID may follow, every eighth byte value; elsewhere it is a character too many") {
  for (unsigned byte = 0; byte < 256; byte++) {
    for (const unsigned end : {0x00u, 0x04u, 0x34u, 0x08u}) {
      const Bytes bytes = bytesOf(plainFrame(1, static_cast<uint8_t>(end))) + tailOf(static_cast<uint8_t>(end)) +
                          Bytes{static_cast<uint8_t>(byte)};
      CHECK(rules::isSlotNext(Case{bytes}.candidate()) == ((end & 0x0F) == 4 && byte % 8 == 3));
    }
  }
}

TEST_CASE("breaks: a 00 may stand before the slot's ID, one only, and on S.BUS2 lines only") {
  for (const unsigned end : {0x00u, 0x04u, 0x34u}) {
    const Bytes frame = bytesOf(plainFrame(1, static_cast<uint8_t>(end)));
    const auto isSlotNext = [&frame](const Bytes &behind) { return rules::isSlotNext(Case{frame + behind}.candidate()); };
    CHECK(isSlotNext({0x00, 0x13}) == (end != 0x00));
    CHECK_FALSE(isSlotNext({0x00, 0x15}));
    CHECK_FALSE(isSlotNext({0x00, 0x00, 0x13}));
    CHECK_FALSE(isSlotNext({0x55, 0x13}));
    CHECK_FALSE(isSlotNext({0x00}));
  }
}

TEST_CASE("twice: on a line with breaks the end byte of another variant may be one") {
  for (uint8_t variant = 0; variant < UnknownVariant; variant++) {
    CHECK(rules::mayEndInBreak<Frame16>(variant, true) == (variant != SlotsVariant));
    CHECK_FALSE(rules::mayEndInBreak<Frame16>(variant, false));
  }
}

TEST_CASE("repeatsEnd: noise may come before the header, unless a stray character is known to follow each frame") {
  const struct {
    unsigned next;
    int gapAt, offBy;
    bool twice;
  } rows[] = {{0x00, Far, 0, true}, {0x00, 0, 0, true}, {0x00, Far, 1, true}, {0x00, 0, 1, false}, {0x01, Far, 0, false}};
  for (const auto &row : rows) {
    INFO("next ", row.next, ", gapAt ", row.gapAt, ", offBy ", row.offBy);
    const Case c = {Plain + Bytes{static_cast<uint8_t>(row.next)}, row.gapAt, row.offBy};
    CHECK(rules::repeatsEnd(c.candidate()) == row.twice);
    CHECK((judged(c) == "goes on 2") == (row.twice && row.offBy == 0));  // and a header at 1 is no better
  }
}

TEST_CASE("falseSync: before the first frame any end byte before either header counts, later those of the line's variant") {
  for (const unsigned header : {0x0Fu, 0x2Fu}) {
    for (const unsigned end : {0x00u, 0x04u, 0x24u, 0x08u}) {
      for (const unsigned inside : {0x00u, 0x04u, 0x14u, 0x08u, 0x40u, 0x01u}) {
        INFO("header ", header, ", end ", end, ", inside ", inside);
        Bytes bytes = bytesOf(plainFrame(1, static_cast<uint8_t>(end)));
        bytes[12] = static_cast<uint8_t>(inside);
        bytes[13] = static_cast<uint8_t>(header);
        const bool isSame = (end & 0x0F) == 4 ? (inside & 0x0F) == 4 : inside == end;
        const bool isAny = isEndByte(static_cast<uint8_t>(inside));
        CHECK((rules::falseSyncAt(Case{bytes}.candidate()) == 13) == isSame);
        CHECK((rules::falseSyncAt(Case{bytes, Far, 0, true, false}.candidate()) == 13) == isAny);
      }
    }
  }
}

TEST_CASE("goesOn: more than four characters follow, and the second is no header") {
  for (size_t count = 1; count < 9; count++) {
    for (const uint8_t second : {uint8_t{0x0F}, uint8_t{0x55}}) {
      Bytes bytes = Plain + Bytes(count, 0x55);
      bytes.push_back(0);
      bytes.resize(25 + count);
      if (count > 1) {
        bytes[26] = second;
      }
      CAPTURE(count);
      CHECK(rules::goesOn(Case{bytes + Bytes{}}.candidate()) == (count > 4 && second != 0x0F));
    }
  }
}

TEST_CASE("falseSync: out of sync an end byte and a header inside reject, up to that header") {
  for (size_t place = 2; place < 24; place++) {
    CAPTURE(place);
    Bytes bytes = Plain;
    bytes[place - 1] = 0x00;
    bytes[place] = 0x0F;
    const int at = static_cast<int>(place);
    CHECK(rules::falseSyncAt(Case{bytes}.candidate()) == at);
    const Bytes before = bytes + Bytes{0x0F};
    CHECK(judged({before, Far, 0, false}) == "false sync " + std::to_string(at));
    CHECK(judged({before, Far, 30}) == "false sync " + std::to_string(at));
    CHECK(judged({before, Far, 0, true}) == "aligned");
    CHECK(judged({before, 0, 30}) == "aligned");
    CHECK(judged({before, 25, 30}) == "aligned");
    CHECK(judged({before, 0, 30, false, true, false}) == "false sync " + std::to_string(at));  // a likely gap
  }
  CHECK(rules::falseSyncAt(Case{Plain}.candidate()) == 25);
  CHECK(rules::falseSyncAt(Case{Failsafe}.candidate()) == 23);
  CHECK(judged({Plain + Bytes{0x0F}, Far, 30}) == "accept");
}

TEST_CASE(
    "waits: a gap after a frame may prove that it is aligned, unless a short part may be the rest of the frame "
    "before") {
  for (size_t place = 2; place < 24; place++) {
    for (int offBy = -2; offBy < 30; offBy++) {
      INFO("place ", place, ", offBy ", offBy);
      Bytes bytes = Plain;
      bytes[place - 1] = 0x00;
      bytes[place] = 0x0F;
      const bool waits = place >= 12 || offBy <= 4;
      CHECK((judged({bytes, Far, offBy, false}) == "wait") == waits);
      CHECK(judged({bytes + Bytes{0x0F}, Far, offBy, false}) == "false sync " + std::to_string(place));
    }
  }
}

TEST_CASE("isExactlyNext accepts only what judge() accepts as aligned") {
  const auto check = [](const Bytes &bytes, int gapAt, uint8_t variant, bool isInSync) {
    INFO(bytes, ", gapAt ", gapAt, ", variant ", unsigned{variant}, ", isInSync ", isInSync);
    bool accepted = false;
    if (bytes.size() == 25 && variantOfEnd(bytes[24]) == variant && isInSync && bytes[0] == 0x0F &&
        isFlagsByte(bytes[23])) {
      FrameSizeCheck<Frame16> acquisition = noneSeen();
      accepted = rules::judge(Case{bytes, gapAt}.candidate(), acquisition).isAligned();
    }
    const bool usual = rules::isExactlyNext<Frame16>(bytes.data(), static_cast<int>(bytes.size()), gapAt, variant, isInSync);
    CHECK(usual == (accepted && gapAt != 25));  // a gap behind is found by an empty poll, and that is not usual
    return usual;
  };
  unsigned usual = 0;
  for (const size_t inner : {0u, 2u, 12u, 22u}) {  // where a header stands behind an end byte; 0: nowhere
    for (const uint8_t end : {uint8_t{0x00}, uint8_t{0x04}, uint8_t{0x14}, uint8_t{0x08}, uint8_t{0x55}}) {
      for (const uint8_t flags : {uint8_t{0x00}, uint8_t{0x0F}, uint8_t{0x10}}) {
        for (const uint8_t header : {uint8_t{0x0F}, uint8_t{0x2F}}) {
          Bytes bytes(25, 0x55);
          bytes[inner] = 0x0F;
          bytes[inner == 0 ? 1 : inner - 1] = end;
          bytes[0] = header;
          bytes[23] = flags;
          bytes[24] = end;
          for (const int gapAt : {0, 1, 24, 25, Far}) {
            for (const uint8_t variant : {uint8_t{0}, uint8_t{1}, uint8_t{2}}) {
              for (const bool isInSync : {false, true}) {
                usual += check(bytes, gapAt, variant, isInSync);
                usual += check(part(bytes, 0, 24), gapAt, variant, isInSync);
              }
            }
          }
        }
      }
    }
  }
  CHECK(usual == 4 * 4 * 2 * 2);  // inner headers, end bytes, flags, gaps
}
