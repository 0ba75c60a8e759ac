// When 25 characters are a frame: each rule by itself, and all of them together.
#include <doctest/doctest.h>

#include <string>

#include "sbus/FrameRules.h"
#include "sbus2/Slots.h"
#include "support/Bytes.h"
#include "support/KnownFrames.h"
#include "support/ShowArrays.h"

using namespace sbus;

namespace {

constexpr int Far = 255;  // Case::gapAt without a gap

// A frame and what follows it. By default it is where a frame is expected, on a line of its variant.
struct Case {
  Bytes bytes;
  int gapAt = Far;
  int distance = 0;
  bool isInSync = true;
  bool hasLineVariant = true;
  bool isGapCertain = true;
  Silence inside = Silence::Unknown;  // the longest gap inside before the newest
  bool beginsWide = false;
  bool isGapWide = false;
  bool isGapLate = false;

  template <typename Format = Frame16>
  Candidate<Format> candidate() const {
    const Silence gap = isGapLate      ? Silence::Late
                        : isGapWide    ? Silence::Wide
                        : isGapCertain ? Silence::Gap
                                       : Silence::Likely;
    const bool follows = isInSync && distance == 0;
    const uint8_t variant = variantOfEnd(bytes[24]);
    const auto number = [](auto of) { return static_cast<int_fast8_t>(of); };
    return {bytes.data(),     number(bytes.size()),
            number(gapAt),    gap,
            inside,           beginsWide || follows,
            variant,          hasLineVariant ? variant : NoVariant,
            number(distance), follows};
  }
};

const Bytes Plain = bytesOf(plainFrame(1));
const Bytes Failsafe = bytesOf(FailsafeFrame);  // allows a false sync at 23

// Returns a line of which nothing has been seen yet.
template <typename Format = Frame16>
FrameSizeCheck<Format> noneSeen() {
  FrameSizeCheck<Format> sizeCheck;
  sizeCheck.reset();
  return sizeCheck;
}

// Returns a line on which two gaps have been seen, `run` characters apart.
FrameSizeCheck<Frame16> twoGaps(unsigned run) {
  FrameSizeCheck<Frame16> sizeCheck = noneSeen();
  sizeCheck.gap(0, true);
  sizeCheck.characters(run);
  sizeCheck.gap(static_cast<int>(run), true);
  return sizeCheck;
}

// Returns a line whose sender stretches frames.
FrameSizeCheck<Frame16> stretching() {
  FrameSizeCheck<Frame16> sizeCheck = noneSeen();
  sizeCheck.stretchedFrame();
  sizeCheck.stretchedFrame();
  return sizeCheck;
}

// Returns "accept", "aligned", "wait", or why it is rejected and after how many characters the search continues.
template <typename Format = Frame16>
std::string judged(const Case &c, FrameSizeCheck<Format> sizeCheck = noneSeen<Format>()) {
  static const char *const names[] = {"no end", "flags", "gap inside", "goes on", "not at gap", "false sync"};
  const Verdict verdict = rules::judge(c.candidate<Format>(), sizeCheck);
  return verdict.isAligned()    ? "aligned"
         : verdict.isAccepted() ? "accept"
         : verdict.isOpen()     ? "wait"
                                : names[static_cast<unsigned>(verdict.why())] + (" " + std::to_string(verdict.skip()));
}

}  // namespace

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
    "late: a frame whose characters only came late is delivered, if it is due and the next may follow it directly") {
  constexpr Silence None = Silence::Unknown;
  for (int gapAt = 1; gapAt < 25; gapAt++) {
    CAPTURE(gapAt);
    const std::string rejected = "gap inside " + std::to_string(gapAt);
    const auto lateAt = [gapAt](const Bytes &bytes, Silence inside, int distance = 0) {
      return Case{bytes, gapAt, distance, distance == 0, true, true, inside, false, false, true};
    };
    const Bytes header = Plain + Bytes{0x0F}, other = Plain + Bytes{0x55};
    for (const Silence inside : {None, Silence::Late}) {
      CHECK(judged(lateAt(Plain, inside), stretching()) == "aligned");
      CHECK(judged(lateAt(header, inside), stretching()) == "aligned");
      CHECK(judged(lateAt(Plain, inside)) == "gap inside 25");  // the first such frame
      CHECK(judged(lateAt(header, inside)) == "gap inside 25");
      CHECK(judged(lateAt(other, inside), stretching()) == rejected);
      CHECK(judged(lateAt(Plain, inside, 1), stretching()) == rejected);
    }
    CHECK(judged(lateAt(Failsafe, None), stretching()) == "wait");  // it allows a false sync
    for (const Silence inside : {Silence::Likely, Silence::Gap}) {
      CHECK(judged(lateAt(Plain, inside), stretching()) == "wait");
      CHECK(judged(lateAt(header, inside), stretching()) == rejected);
    }
  }
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

TEST_CASE("slots behind: the first frame waits for twelve characters if others came before it on the line") {
  const struct {
    const char *what;
    size_t behind;  // the next header, and the characters behind it
    int gapAt, distance;
    const char *verdict;
  } rows[] = {
      {"the line's beginning", 1, Far, 2, "accept"}, {"a character before it", 1, Far, 3, "wait"},
      {"... and eleven behind", 11, Far, 3, "wait"}, {"... and twelve", 12, Far, 3, "accept"},
      {"a gap before it", 1, 0, 3, "aligned"},       {"a gap behind it", 1, 25, 3, "aligned"},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    CHECK(judged({Plain + Bytes{0x0F} + Bytes(row.behind - 1, 0x55), row.gapAt, row.distance, false, false}) ==
          row.verdict);
  }
}

TEST_CASE(
    "2F: extra channels are accepted on a line of known variant, in their place or at a gap, before a gap or a "
    "header") {
  const Bytes extra = bytesOf(withByte(plainFrame(1), 0, ExtraHeader));
  const struct {
    const char *what;
    Bytes bytes;
    int gapAt, distance;
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
    CHECK(judged<Frame16Extra>({row.bytes, row.gapAt, row.distance, true, row.hasLineVariant}) == row.verdict);
  }
}

TEST_CASE("breaks: a 00 may stand before the slot's ID, one only, and on S.BUS2 lines only") {
  for (const unsigned end : {0x00u, 0x04u, 0x34u}) {
    const Bytes frame = bytesOf(plainFrame(1, static_cast<uint8_t>(end)));
    const auto isSlotNext = [&frame](const Bytes &behind) {
      return rules::isSlotNext(Case{frame + behind}.candidate());
    };
    CHECK(isSlotNext({0x00, 0x13}) == (end != 0x00));
    CHECK_FALSE(isSlotNext({0x00, 0x15}));
    CHECK_FALSE(isSlotNext({0x00, 0x00, 0x13}));
    CHECK_FALSE(isSlotNext({0x55, 0x13}));
    CHECK_FALSE(isSlotNext({0x00}));
  }
}

TEST_CASE("repeatsEnd: noise may come before the header, unless a stray character is known to follow each frame") {
  const struct {
    unsigned next;
    int gapAt, distance;
    bool twice;
  } rows[] = {
      {0x00, Far, 0, true}, {0x00, 0, 0, true}, {0x00, Far, 1, true}, {0x00, 0, 1, false}, {0x01, Far, 0, false}};
  for (const auto &row : rows) {
    INFO("next ", row.next, ", gapAt ", row.gapAt, ", distance ", row.distance);
    const Case c = {Plain + Bytes{static_cast<uint8_t>(row.next)}, row.gapAt, row.distance};
    CHECK(rules::repeatsEnd(c.candidate()) == row.twice);
    CHECK((judged(c) == "goes on 2") == (row.twice && row.distance == 0));  // and a header at 1 is no better
  }
}

TEST_CASE(
    "falseSync: before the first frame any end byte before either header counts, later those of the line's variant") {
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

TEST_CASE("slots inside: before the first frame, three slots of one group in a row reject, or two before a header") {
  for (uint8_t group = 0; group < 4; group++) {
    for (size_t place = 1; place < 20; place++) {
      for (size_t third = 0; third < 32; third++) {
        INFO("group ", unsigned{group}, ", place ", place, ", third ", third);
        Bytes bytes = Plain + Bytes{0x0F};
        bytes[place] = slotId(static_cast<uint8_t>(8 * group));
        bytes[place + 3] = slotId(static_cast<uint8_t>(8 * group + 1));
        const size_t at = place + 6;
        const bool isInside = at < 23;
        bytes[isInside ? at : 22] = isInside ? slotId(static_cast<uint8_t>(third)) : bytes[22];
        const bool areSlots = isInside ? third / 8 == group : at == 25;
        CHECK(judged({bytes, Far, 0, false, false}) == (areSlots ? "false sync 1" : "aligned"));
        CHECK(judged({bytes, Far, 0, false, true}) == "aligned");  // the line's variant is known
        CHECK(judged({bytes, 0, 0, false, false}) == "aligned");   // a gap comes before it
        CHECK(judged({bytes, 25, 0, false, false}) == "aligned");  // or follows
      }
    }
  }
}

TEST_CASE("slots inside: three slots behind the header that follows the first frame reject it, but not its own slots") {
  for (size_t place = 25; place < 31; place++) {
    CAPTURE(place);
    Bytes bytes = bytesOf(plainFrame(1, 0x14)) + Bytes{0x0F} + Bytes(11, 0x55);
    for (uint8_t slot = 0; slot < 3; slot++) {
      bytes[place + 3 * slot] = slotId(static_cast<uint8_t>(8 + slot));
    }
    bytes[25] = place < 27 ? bytes[25] : 0x0F;
    const bool areItsOwn = place < 27;  // directly behind it, or behind its break
    const std::string verdict = judged({bytes, Far, 0, false, false});
    CHECK((verdict == "false sync 1") == !areItsOwn);
  }
}

TEST_CASE(
    "waits: a gap after a frame may prove that it is aligned, unless a short part may be the rest of the frame "
    "before") {
  for (size_t place = 2; place < 24; place++) {
    for (int distance = -2; distance < 30; distance++) {
      INFO("place ", place, ", distance ", distance);
      Bytes bytes = Plain;
      bytes[place - 1] = 0x00;
      bytes[place] = 0x0F;
      const bool waits = place >= 12 || distance <= 4 || distance == 25;  // a frame with header 2F has come before
      CHECK((judged({bytes, Far, distance, false}) == "wait") == waits);
      CHECK(judged({bytes + Bytes{0x0F}, Far, distance, false}) == "false sync " + std::to_string(place));
    }
  }
}

TEST_CASE("isExactlyNext accepts only what judge() accepts as aligned") {
  const auto check = [](const Bytes &bytes, int gapAt, uint8_t variant, bool isInSync) {
    INFO(bytes, ", gapAt ", gapAt, ", variant ", unsigned{variant}, ", isInSync ", isInSync);
    bool accepted = false;
    if (bytes.size() == 25 && variantOfEnd(bytes[24]) == variant && isInSync && bytes[0] == 0x0F &&
        isFlagsByte(bytes[23])) {
      FrameSizeCheck<Frame16> sizeCheck = noneSeen();
      accepted = rules::judge(Case{bytes, gapAt}.candidate(), sizeCheck).isAligned();
    }
    const bool usual =
        rules::isExactlyNext<Frame16>(bytes.data(), static_cast<int>(bytes.size()), gapAt, variant, isInSync);
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

// ---- Before the first frame

TEST_CASE("turn: before the first frame, a slot's ID ends a frame if the frame before it announced the group before") {
  for (unsigned first = 0; first < 4; first++) {
    for (unsigned second = 0; second < 4; second++) {
      INFO("first ", first, ", second ", second);
      FrameSizeCheck<Frame16> sizeCheck = noneSeen();
      const auto judge = [&](unsigned group) {
        const Bytes bytes = bytesOf(plainFrame(1, static_cast<uint8_t>(group << 4 | 4))) + Bytes{0x03, 0xC0};
        const Case c = {bytes, Far, 0, true, false};
        return rules::judge(c.candidate(), sizeCheck).isAccepted();
      };
      CHECK_FALSE(judge(first));
      CHECK(judge(second) == (second == (first + 1) % 4));
    }
  }
}

TEST_CASE("stray: of two headers the first may be the stray character, if a frame can begin with the second") {
  const auto judgedTwice = [](unsigned end, unsigned after) {
    Bytes twice = bytesOf(plainFrame(1, static_cast<uint8_t>(end))) + Bytes{static_cast<uint8_t>(after)};
    twice[1] = 0x0F;
    INFO("end byte ", end, ", then ", after);
    const std::string verdict = judged({twice, 26, 9, false, false}, twoGaps(26));
    CHECK_FALSE((verdict == "aligned" && isFrame(twice.data() + 1)));
    return verdict;
  };
  for (const unsigned end : {0x00u, 0x04u, 0x14u, 0x24u, 0x34u}) {
    for (unsigned after = 0; after < 256; after++) {
      judgedTwice(end, after);
    }
  }
  CHECK(judgedTwice(0x00, 0x00) == "goes on 2");
  CHECK(judgedTwice(0x00, 0x01) == "aligned");
  CHECK(judgedTwice(0x14, 0x00) == "aligned");
}

TEST_CASE("tail: a gap behind a tail aligns the first frame only if there is also a gap before the frame") {
  Bytes tailed = bytesOf(plainFrame(1, 0x08)) + tailOf(0x08);
  tailed[9] = 0x00;
  tailed[10] = 0x0F;  // the tail may be the end of the frame that begins here
  CHECK(judged({tailed, 30, 9, false, false}, twoGaps(30)) == "aligned");
  CHECK(judged({tailed, 30, 9, false, false}, noneSeen()) == "false sync 10");
  CHECK(judged({part(tailed, 0, 25), 25, 9, false, false}, noneSeen()) == "aligned");
  CHECK(judged({tailed, 30, 9, false, true}, noneSeen()) == "aligned");
}

TEST_CASE(
    "other, first: before the first frame a line must show its gaps, and not look like one with the other frame size") {
  const Bytes whole = Plain + Bytes{0x0F} + Bytes(11, 0x55);
  CHECK(judged({whole, Far, 9, false, false}) == "accept");  // no gap was ever seen
  CHECK(judged({whole, Far, 9, false, false}, twoGaps(25)) == "not at gap 1");
  CHECK(judged({whole, 0, 9, false, false}, twoGaps(25)) == "aligned");
  CHECK(judged({whole, 0, 9, false, false}, twoGaps(36)) == "not at gap 1");
  FrameSizeCheck<Frame16> sizeCheck = twoGaps(36);
  for (const char *const verdict : {"not at gap 1", "aligned"}) {  // two frames of the right size end the doubts
    sizeCheck.characters(25);
    sizeCheck.gap(25, true);
    CHECK(judged({whole, 0, 9, false, false}, sizeCheck) == verdict);
  }
}

TEST_CASE("frames are forbidden for eight gaps, or one if the characters may be the end of a frame of the other size") {
  const struct {
    unsigned run;
    int waiting;
    unsigned gaps;
  } rows[] = {{36, 25, 8}, {35, 25, 1}, {36, 36, 8}, {25, 25, 0}, {24, 0, 0},
              {26, 25, 0}, {27, 25, 1}, {37, 25, 0}, {255, 25, 0}};
  for (const auto &row : rows) {
    INFO("run ", row.run, ", waiting ", row.waiting);
    FrameSizeCheck<Frame16> sizeCheck = noneSeen();
    sizeCheck.gap(0, true);
    sizeCheck.characters(row.run);
    CHECK(sizeCheck.gap(row.waiting, true) == (row.run == 36));
    CHECK_FALSE(sizeCheck.gap(row.waiting, true));  // the same gap again
    unsigned gaps = 0;
    for (; !sizeCheck.allows(true, false); gaps++) {
      sizeCheck.characters(3);
      sizeCheck.gap(3, true);
    }
    CHECK(gaps == row.gaps);
  }
}

TEST_CASE("stray: on a line whose variant is known, only where the frame before is missing: it may be mistaken") {
  for (const unsigned end : {0x00u, 0x04u, 0x14u}) {
    for (const int distance : {-1, 0, 1, 25}) {
      INFO("end ", end, ", distance ", distance);
      const Case stray = {bytesOf(plainFrame(1, static_cast<uint8_t>(end))) + Bytes{0x00}, 26, distance, false, false};
      Candidate<Frame16> c = stray.candidate();
      CHECK(rules::mayHaveStray(c));
      c.lineVariant = TailVariant;
      CHECK(rules::mayHaveStray(c) == (distance != 0));
    }
  }
}
