// When 25 characters are the first frame of a line: the rules that hold only until it is found.
#include <doctest/doctest.h>

#include <string>

#include "support/Candidates.h"
#include "support/ShowArrays.h"

using namespace sbus;

TEST_CASE("turn: before the first frame, a slot's ID ends a frame if the frame before it announced the group before") {
  for (unsigned first = 0; first < 4; first++) {
    for (unsigned second = 0; second < 4; second++) {
      INFO("first ", first, ", second ", second);
      FrameSizeCheck<Frame16> acquisition = noneSeen();
      const auto judge = [&](unsigned group) {
        const Bytes bytes = bytesOf(plainFrame(1, static_cast<uint8_t>(group << 4 | 4))) + Bytes{0x03, 0xC0};
        const Case c = {bytes, Far, 0, true, false};
        return rules::judge(c.candidate(), acquisition).isAccepted();
      };
      CHECK_FALSE(judge(first));
      CHECK(judge(second) == (second == (first + 1) % 4));
    }
  }
}

TEST_CASE("stray: one stray character may follow the first frame, between two gaps 26 characters apart") {
  const Bytes stray = Plain + Bytes{0x00};
  CHECK(judged({stray, 0, 9, false, false}, twoGaps(25)) == "wait");
  CHECK(judged({stray, Far, 9, false, false}, twoGaps(25)) == "wait");
  CHECK(judged({stray + Bytes{0x55}, Far, 9, false, false}, twoGaps(25)) == "goes on 2");
  CHECK(judged({stray, 26, 9, false, false}, twoGaps(26)) == "aligned");
  for (const unsigned run : {25u, 27u, 52u, 255u}) {
    CHECK(judged({stray, 26, 9, false, false}, twoGaps(run)) == "wait");
    CHECK(judged({stray + Bytes{0x0F}, 26, 9, false, false}, twoGaps(run)) == "goes on 2");
  }
}

TEST_CASE("stray: on a line whose variant is known, only where the frame before is missing: it may be mistaken") {
  for (const unsigned end : {0x00u, 0x04u, 0x14u}) {
    for (const int offBy : {-1, 0, 1, 25}) {
      INFO("end ", end, ", offBy ", offBy);
      const Case stray = {bytesOf(plainFrame(1, static_cast<uint8_t>(end))) + Bytes{0x00}, 26, offBy, false, false};
      Candidate<Frame16> c = stray.candidate();
      CHECK(rules::mayHaveStray(c));
      c.lineVariant = TailVariant;
      CHECK(rules::mayHaveStray(c) == (offBy != 0));
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
  const Bytes whole = Plain + Bytes{0x0F};
  CHECK(judged({whole, Far, 9, false, false}) == "accept");           // no gap was ever seen
  CHECK(judged({whole, Far, 9, false, false}, twoGaps(25)) == "not at gap 1");
  CHECK(judged({whole, 0, 9, false, false}, twoGaps(25)) == "aligned");
  CHECK(judged({whole, 0, 9, false, false}, twoGaps(36)) == "not at gap 1");
  FrameSizeCheck<Frame16> acquisition = twoGaps(36);
  acquisition.characters(25);
  acquisition.gap(25, true);  // a frame of the right size ends the doubts
  CHECK(judged({whole, 0, 9, false, false}, acquisition) == "aligned");
}

TEST_CASE("frames are forbidden for eight gaps, or one if the characters may be the end of a frame of the other size") {
  const struct {
    unsigned run;
    int waiting;
    unsigned gaps;
  } rows[] = {{36, 25, 8}, {35, 25, 1}, {36, 36, 8}, {25, 25, 0}, {24, 0, 0}, {26, 25, 0}, {27, 25, 1},
              {37, 25, 0}, {255, 25, 0}};
  for (const auto &row : rows) {
    INFO("run ", row.run, ", waiting ", row.waiting);
    FrameSizeCheck<Frame16> acquisition = noneSeen();
    acquisition.gap(0, true);
    acquisition.characters(row.run);
    CHECK(acquisition.gap(row.waiting, true) == (row.run == 36));
    CHECK_FALSE(acquisition.gap(row.waiting, true));  // the same gap again
    unsigned gaps = 0;
    for (; !acquisition.allows(true, false); gaps++) {
      acquisition.characters(3);
      acquisition.gap(3, true);
    }
    CHECK(gaps == row.gaps);
  }
}
