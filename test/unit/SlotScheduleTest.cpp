// The answers of a sensor: in which slot, when, and which slots are skipped.
#include <doctest/doctest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "sbus2/SlotSchedule.h"
#include "support/Bytes.h"
#include "support/KnownFrames.h"

namespace {

using sbus::SlotData;
using sbus::SlotSchedule;

// Data of slot k: k and `round`.
std::vector<SlotData> dataFrom(uint8_t first, uint8_t count, uint8_t round = 0) {
  std::vector<SlotData> data;
  for (uint8_t i = 0; i < count; i++) {
    data.push_back({static_cast<uint8_t>(first + i), round});
  }
  return data;
}

void write(SlotSchedule &answers, uint8_t first, uint8_t count, uint8_t round = 0) {
  CHECK(answers.write(first, count, dataFrom(first, count, round).data()));
}

void take(SlotSchedule &answers, uint8_t end) { answers.accepted(plainFrame(0, end).data()); }

// Reports a frame with this end byte, which ended between these times.
void frame(SlotSchedule &answers, uint8_t end, uint32_t earliest, uint32_t latest, uint32_t gap = 12000) {
  take(answers, end);
  CHECK(answers.takeFrameEnd());
  answers.plan(earliest, latest, gap);
}

// Returns "slot@start: data" of each answer, taken `lateUs` after it is due.
std::string sent(SlotSchedule &answers, uint32_t lateUs = 0) {
  std::string text;
  while (answers.isPlanned()) {
    const uint32_t due = answers.due();
    uint8_t characters[sbus::SlotSize];
    if (answers.start(due + lateUs, characters)) {
      CHECK(sbus::isSlotId(characters[0]));
      text += std::to_string(sbus::slotOfId(characters[0])) + "@" + std::to_string(due) + ":" +
              std::to_string(characters[1]) + "," + std::to_string(characters[2]) + " ";
    }
  }
  return text;
}

}  // namespace

TEST_CASE("an answer stands in its slot, counted from the middle of the time within which the frame ended") {
  const struct {
    uint8_t end;
    uint32_t earliest, latest;
    const char *sent;
  } rows[] = {
      {0x04, 10000, 10000, "1@12690:1,0 7@16650:7,0 "},
      {0x04, 10000, 10100, "1@12740:1,0 7@16700:7,0 "},
      {0x14, 10000, 10020, "8@12040:8,0 9@12700:9,0 "},
      {0x24, 10000, 10020, ""},
      {0x34, 0xFFFFFFF0, 0x10, "24@2030:24,0 31@6650:31,0 "},  // the clock wraps
      {0x00, 10000, 10000, ""},
      {0x08, 10000, 10000, ""},
  };
  for (const auto &row : rows) {
    CAPTURE(int{row.end});
    SlotSchedule answers;
    answers.begin();
    for (const uint8_t slot : Bytes{1, 7, 24, 31}) {
      write(answers, slot, 1);
    }
    write(answers, 8, 2);
    frame(answers, row.end, row.earliest, row.latest);
    CHECK(sent(answers) == row.sent);
    CHECK(answers.skipped() == 0);
  }
}

TEST_CASE("slot 0 is never written, nor a sensor whose slots cross the border of a group") {
  const struct {
    uint8_t first, count;
    bool isTaken;
  } rows[] = {{0, 1, false}, {0, 8, false}, {1, 7, true},   {1, 8, false}, {8, 8, true},  {9, 8, false},
              {7, 2, false}, {31, 1, true}, {32, 1, false}, {24, 8, true}, {5, 0, false}, {255, 1, false}};
  for (const auto &row : rows) {
    CAPTURE(int{row.first});
    CAPTURE(int{row.count});
    SlotSchedule answers;
    answers.begin();
    CHECK(answers.write(row.first, row.count, dataFrom(row.first, row.count).data()) == row.isTaken);
    for (const uint8_t end : Bytes{0x04, 0x14, 0x24, 0x34}) {
      frame(answers, end, 0, 0);
      CHECK(answers.isPlanned() == (row.isTaken && end >> 4 == row.first / 8));
    }
  }
}

TEST_CASE("if the frame's end is known to no better than 100 us, the whole group is skipped and counted") {
  for (const uint32_t apart : {100u, 101u, 3000u, 65535u, 0x80000000u}) {
    CAPTURE(apart);
    SlotSchedule answers;
    answers.begin();
    write(answers, 2, 3);
    frame(answers, 0x04, 1000, 1000 + apart);
    CHECK(answers.isPlanned() == (apart == 100));
    CHECK(answers.skipped() == (apart == 100 ? 0 : 3));
  }
}

TEST_CASE("an answer that could start more than 100 us late is skipped, and the rest of the group with it") {
  const struct {
    uint32_t apart, lateUs;
    unsigned sent, skipped;
  } rows[] = {{0, 100, 3, 0}, {0, 101, 0, 3}, {40, 80, 3, 0}, {40, 81, 0, 3}, {100, 50, 3, 0}, {100, 51, 0, 3}};
  for (const auto &row : rows) {
    CAPTURE(row.apart);
    CAPTURE(row.lateUs);
    SlotSchedule answers;
    answers.begin();
    write(answers, 2, 3);
    frame(answers, 0x04, 1000, 1000 + row.apart);
    sent(answers, row.lateUs);
    CHECK(answers.sent() == row.sent);
    CHECK(answers.skipped() == row.skipped);
  }
}

TEST_CASE("an answer that was not sent before the next frame is skipped: none is sent twice, or in the next frame") {
  SlotSchedule answers;
  answers.begin();
  write(answers, 2, 3);
  frame(answers, 0x04, 1000, 1000);
  uint8_t characters[sbus::SlotSize];
  CHECK(answers.start(answers.due(), characters));
  take(answers, 0x14);
  CHECK(!answers.isPlanned());
  CHECK(!answers.start(answers.due(), characters));
  CHECK(answers.sent() == 1);
  CHECK(answers.skipped() == 2);
}

TEST_CASE("an answer holds the data of the frame's end, also if new data come before it is sent") {
  SlotSchedule answers;
  answers.begin();
  write(answers, 8, 3, 1);
  frame(answers, 0x14, 0, 0);
  write(answers, 8, 3, 2);
  CHECK(sent(answers) == "8@2030:8,1 9@2690:9,1 10@3350:10,1 ");
  frame(answers, 0x14, 0, 0);
  CHECK(sent(answers) == "8@2030:8,2 9@2690:9,2 10@3350:10,2 ");
  answers.stop(9, 2);
  frame(answers, 0x14, 0, 0);
  CHECK(sent(answers) == "8@2030:8,2 ");
}

TEST_CASE("only a frame's last byte tells its end: a byte that others follow does not") {
  const uint8_t bytes[] = {0x03, 0xC0, 0x2E};
  SlotSchedule answers;
  answers.begin();
  CHECK(!answers.takeFrameEnd());
  take(answers, 0x04);
  CHECK(answers.takeFrameEnd());
  CHECK(!answers.takeFrameEnd());
  take(answers, 0x04);
  answers.discarded(bytes, 3);
  CHECK(!answers.takeFrameEnd());
  take(answers, 0x04);
  answers.lost();
  CHECK(!answers.takeFrameEnd());
}

TEST_CASE(
    "the echo of its own characters is no sensor; other characters in their place are a collision, and no sensor "
    "either") {
  const uint8_t own[] = {sbus::slotId(2), 2, 0};
  const uint8_t torn[] = {sbus::slotId(2), 2};
  const uint8_t others[] = {sbus::slotId(2), 2, 1};
  const uint8_t both[] = {sbus::slotId(1), 7, 7, sbus::slotId(2), 2, 0};
  const struct {
    const char *what;
    std::vector<uint8_t> back;
    unsigned collisions;
    bool hasSlot1, wasHeard;
  } rows[] = {
      {"its own", {own, own + 3}, 0, false, false},
      {"nothing: RX does not hear TX", {}, 0, false, false},
      {"nothing: the answer was destroyed", {}, 1, false, true},
      {"other data", {others, others + 3}, 1, false, false},
      {"less", {torn, torn + 2}, 1, false, false},
      {"a sensor's and its own", {both, both + 6}, 0, true, false},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    SlotSchedule answers;
    answers.begin();
    write(answers, 2, 1);
    if (row.wasHeard) {
      frame(answers, 0x04, 0, 0);
      sent(answers);
      answers.discarded(own, 3);
      take(answers, 0x14);
    }
    frame(answers, 0x04, 0, 0);
    sent(answers);
    if (!row.back.empty()) {
      answers.discarded(row.back.data(), static_cast<int>(row.back.size()));
    }
    take(answers, 0x14);
    CHECK(answers.collisions() == row.collisions);
    SlotData data;
    CHECK(!answers.read(2, 1, &data));
    CHECK(answers.read(1, 1, &data) == row.hasSlot1);
  }
}

TEST_CASE("an answer that the port could not send counts as skipped, and its echo is not expected") {
  SlotSchedule answers;
  answers.begin();
  write(answers, 2, 3);
  for (const unsigned unsent : {2u, 3u, 4u}) {
    CAPTURE(unsent);
    frame(answers, 0x04, 10000, 10000);
    for (uint8_t slot = 2; slot <= 4; slot++) {
      uint8_t characters[sbus::SlotSize];
      REQUIRE(answers.start(answers.due(), characters));
      CHECK(sbus::slotOfId(characters[0]) == slot);
      if (slot == unsent) {
        answers.unsent();
      } else {
        answers.discarded(characters, sizeof characters);
      }
    }
    CHECK(answers.sent() == 2 * (unsent - 1));
    CHECK(answers.skipped() == unsent - 1);
    take(answers, 0x14);
    CHECK(answers.collisions() == 0);
    SlotData data;
    CHECK(!answers.read(2, 1, &data));
  }
}

TEST_CASE("the timer polls all the time while a frame's end is expected, and otherwise seldom") {
  SlotSchedule answers;
  answers.begin();
  CHECK(answers.nextPoll(12345) == 500);
  frame(answers, 0x04, 100000, 100040);  // 100020, give or take 20; 150 us more for clocks that differ
  const struct {
    uint32_t now;
    uint16_t poll;
  } rows[] = {{100100, 500}, {114000, 500}, {114400, 450}, {114849, 1},   {114850, 0}, {115020, 0},  {115190, 0},
              {115191, 500}, {129850, 0},   {130190, 0},   {130191, 500}, {159850, 0}, {174850, 500}};
  for (const auto &row : rows) {
    CAPTURE(row.now);
    CHECK(answers.nextPoll(row.now) == row.poll);
  }
  frame(answers, 0x14, 200000, 215000);  // nothing is known
  CHECK(answers.nextPoll(222500) == 500);
}

TEST_CASE("no answer is planned that might run into the next frame, however early that comes") {
  const struct {
    uint32_t gap;  // us, until the next frame
    const char *slots;
  } rows[] = {
      {12000, "8 9 10 11 12 13 14 15 "},
      {7111, "8 9 10 11 12 13 14 15 "},
      {7110, "8 9 10 11 12 13 14 "},
      {4000, "8 9 10 "},
      {2491, "8 "},
      {2490, ""},
      {0, ""},
  };
  for (const auto &row : rows) {
    CAPTURE(row.gap);
    SlotSchedule answers;
    answers.begin();
    write(answers, 8, 8);
    frame(answers, 0x14, 1000, 1000, row.gap);
    std::string slots;
    while (answers.isPlanned()) {
      uint8_t characters[sbus::SlotSize];
      CHECK(answers.start(answers.due(), characters));
      slots += std::to_string(sbus::slotOfId(characters[0])) + " ";
    }
    CHECK(slots == row.slots);
    CHECK(answers.sent() + answers.skipped() == 8);
  }
}
