// Telemetry slots: their numbers and IDs, and the characters between two frames split into slots.
#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "sbus2/Slots.h"

namespace {

using Bytes = std::vector<uint8_t>;

// Returns "slot:data0 data1" of each slot, or "rejected" if the characters are no slots.
std::string read(uint8_t end, const Bytes &characters, uint32_t &breaks) {
  sbus::Slot slots[sbus::SlotsOfGroup];
  const int count = sbus::readSlots(end, characters.data(), static_cast<uint8_t>(characters.size()), slots, breaks);
  if (count < 0) {
    return "rejected";
  }
  std::string text;
  for (int i = 0; i < count; i++) {
    char slot[16];
    std::snprintf(slot, sizeof slot, "%s%d:%02X%02X", i > 0 ? " " : "", slots[i].number, slots[i].data.data0,
                  slots[i].data.data1);
    text += slot;
  }
  return text;
}

std::string read(uint8_t end, const Bytes &characters) {
  uint32_t breaks = 0;
  return read(end, characters, breaks);
}

Bytes wholeGroup(uint8_t group, bool hasBreaks = false) {
  Bytes characters(hasBreaks ? 1 : 0, 0x00);
  for (uint8_t i = 0; i < sbus::SlotsOfGroup; i++) {
    const auto data = static_cast<uint8_t>(i + 1);
    characters.insert(characters.end(), {sbus::slotId(static_cast<uint8_t>(8 * group + i)), data, data});
    if (hasBreaks) {
      characters.push_back(0x00);
    }
  }
  return characters;
}

}  // namespace

TEST_CASE("the 32 slots have the IDs that four projects agree on, and the IDs give back the slots") {
  // BrushlessPower, msrc, jitel and Kasai's table; 03, 83, 43, B3, 73 and F3 were seen on real lines.
  const uint8_t ids[] = {0x03, 0x83, 0x43, 0xC3, 0x23, 0xA3, 0x63, 0xE3, 0x13, 0x93, 0x53,
                         0xD3, 0x33, 0xB3, 0x73, 0xF3, 0x0B, 0x8B, 0x4B, 0xCB, 0x2B, 0xAB,
                         0x6B, 0xEB, 0x1B, 0x9B, 0x5B, 0xDB, 0x3B, 0xBB, 0x7B, 0xFB};
  unsigned known = 0;
  for (uint8_t slot = 0; slot < sbus::SlotCount; slot++) {
    CAPTURE(int{slot});
    CHECK(sbus::slotId(slot) == ids[slot]);
    CHECK(sbus::slotOfId(ids[slot]) == slot);
  }
  for (unsigned byte = 0; byte < 256; byte++) {
    known += sbus::isSlotId(static_cast<uint8_t>(byte));
  }
  CHECK(known == sbus::SlotCount);
  CHECK(!sbus::isSlotId(sbus::HeaderByte));
  CHECK(!sbus::isSlotId(sbus::ExtraHeader));
}

TEST_CASE("the end byte announces a group, slot 0 alone, or nothing") {
  const struct {
    uint8_t end;
    bool announces;
    int first;
  } rows[] = {{0x00, false, 0}, {0x04, true, 0}, {0x14, true, 8}, {0x24, true, 16}, {0x34, true, 24}, {0x08, true, 0}};
  for (const auto &row : rows) {
    CAPTURE(int{row.end});
    CHECK(sbus::announcesSlots(row.end) == row.announces);
    CHECK(sbus::firstSlotOf(row.end) == row.first);
  }
}

TEST_CASE("the characters between two frames are slots of the announced group, or are rejected") {
  const struct {
    const char *what;
    uint8_t end;
    Bytes characters;
    const char *slots;
  } rows[] = {
      {"no sensor answers", 0x14, {}, ""},
      {"the receiver, PX4's capture", 0x04, {0x03, 0xC0, 0x2E}, "0:C02E"},
      {"an SBS-01V in slots 1 and 2, msrc#173",
       0x04,
       {0x03, 0xC0, 0x2E, 0x83, 0x80, 0x38, 0x43, 0x00, 0x7D},
       "0:C02E 1:8038 2:007D"},
      {"a GPS's last slots", 0x14, {0xB3, 0x60, 0xED, 0x73, 0xF4, 0x15, 0xF3, 0xE1, 0xAE}, "13:60ED 14:F415 15:E1AE"},
      {"a whole group", 0x34, wholeGroup(3), "24:0101 25:0202 26:0303 27:0404 28:0505 29:0606 30:0707 31:0808"},
      {"data that are IDs", 0x04, {0x03, 0x83, 0x43, 0x83, 0xC3, 0x23}, "0:8343 1:C323"},
      {"a character is missing: it does not take the next ID", 0x04, {0x03, 0xC0, 0x83, 0x80, 0x38}, "rejected"},
      {"an ID is missing", 0x04, {0xC0, 0x2E, 0x83, 0x80, 0x38}, "rejected"},
      {"two are missing, of different slots", 0x04, {0x03, 0xC0, 0x83, 0x80, 0x43, 0x00, 0x7D}, "rejected"},
      {"a character too much", 0x04, {0x03, 0xC0, 0x2E, 0x2E}, "rejected"},
      {"another group", 0x14, {0x83, 0x80, 0x38}, "rejected"},
      {"the same slot twice: two sensors", 0x04, {0x83, 0x80, 0x38, 0x83, 0x00, 0x7D}, "rejected"},
      {"slots in falling order", 0x04, {0x43, 0x80, 0x38, 0x83, 0x00, 0x7D}, "rejected"},
      {"after a frame that announces nothing", 0x00, {0x03, 0xC0, 0x2E}, "rejected"},
      {"an R7003SB, bolderflight#79", 0x08, {0x00, 0x03, 0xC0, 0x33, 0x00}, "0:C033"},
      {"an R7003SB with the radio off", 0x08, {0x00, 0x03, 0x04, 0x00, 0x00}, "0:0400"},
      {"FASSTest 12CH without the two 00", 0x08, {0x03, 0xE0, 0x31}, "0:E031"},
      {"a sensor in FASSTest 12CH", 0x08, {0x83, 0x80, 0x38}, "rejected"},
      {"an R7008SB with breaks", 0x04, {0x00, 0x03, 0xC0, 0x31, 0x00}, "0:C031"},
      {"... no sensor answers", 0x14, {0x00}, ""},
      {"... data that are 00", 0x04, {0x00, 0x03, 0x00, 0x00, 0x00, 0x83, 0x80, 0x00, 0x00}, "0:0000 1:8000"},
      {"... a sensor that sends none", 0x04, {0x00, 0x03, 0xC0, 0x31, 0x00, 0x83, 0x80, 0x38}, "0:C031 1:8038"},
      {"a break after the frame only", 0x04, {0x00, 0x03, 0xC0, 0x31, 0x83, 0x80, 0x38}, "0:C031 1:8038"},
      {"two before a slot", 0x04, {0x00, 0x00, 0x03, 0xC0, 0x31}, "rejected"},
      {"two after a slot", 0x04, {0x03, 0xC0, 0x31, 0x00, 0x00}, "rejected"},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    CHECK(read(row.end, row.characters) == row.slots);
  }
}

namespace {

// A group with some of its slots, whose data are often 00 or the ID of one of its slots.
struct Group {
  uint8_t number, expected = 0, breaks;
  Bytes characters;
  sbus::SlotData data[8];
  unsigned size = 0;  // slots

  Group(std::minstd_rand &random, bool hasBreaks) : number(random() % 4), breaks(hasBreaks ? 0xFF : 0) {
    const auto any = [&] {
      const unsigned value = random() % 256, kind = random() % 4;
      return static_cast<uint8_t>(kind == 0   ? 0
                                  : kind == 1 ? sbus::slotId(static_cast<uint8_t>(8 * number + value % 8))
                                              : value);
    };
    if (hasBreaks) {
      characters.push_back(0);
    }
    for (uint8_t k = 0; k < 8; k++) {
      data[k] = {any(), any()};
      if (random() % 4 != 0) {
        size++;
        expected = static_cast<uint8_t>(expected | 1 << k);
        characters.insert(characters.end(),
                          {sbus::slotId(static_cast<uint8_t>(8 * number + k)), data[k].data0, data[k].data1});
        if (hasBreaks) {
          characters.push_back(0);
        }
      }
    }
  }

  // Reads other characters than its own. Returns how many slots have its data, and adds the others to `wrong`.
  unsigned read(Bytes impaired, unsigned &wrong) const {
    sbus::SlotData found[8];
    const auto count = static_cast<uint8_t>(impaired.size());
    impaired.resize(sbus::GroupSizeMax + 1);
    const uint8_t whole =
        sbus::wholeSlots(static_cast<uint8_t>(number << 4 | 4), false, impaired.data(), count, expected, breaks, found);
    unsigned right = 0;
    for (unsigned k = 0; k < 8; k++) {
      const bool isSame = found[k].data0 == data[k].data0 && found[k].data1 == data[k].data1;
      right += (whole >> k & 1) != 0 && isSame;
      wrong += (whole >> k & 1) != 0 && (!isSame || (expected >> k & 1) == 0);
    }
    return right;
  }
};

}  // namespace

TEST_CASE(
    "if a character of a group is lost, or one too many stands between slots, no wrong slot is read; if two are, few") {
  std::minstd_rand random(1);
  unsigned slots[3] = {}, read[3] = {}, wrong[3] = {};
  for (unsigned i = 0; i < 4000; i++) {
    const bool hasBreaks = i % 2 != 0;
    const Group group(random, hasBreaks);
    const std::ptrdiff_t size = static_cast<std::ptrdiff_t>(group.characters.size());
    for (std::ptrdiff_t lost = hasBreaks ? 1 : 0; lost < size; lost++) {
      Bytes impaired = group.characters;
      impaired.erase(impaired.begin() + lost);
      slots[0] += group.size;
      read[0] += group.read(impaired, wrong[0]);
      if (lost + 1 < size) {
        impaired.erase(impaired.begin() + lost +
                       static_cast<std::ptrdiff_t>(random() % static_cast<unsigned>(size - lost - 1)));
        slots[1] += group.size;
        read[1] += group.read(impaired, wrong[1]);
      }
    }
    const std::ptrdiff_t pitch = hasBreaks ? 4 : 3;
    for (std::ptrdiff_t at = hasBreaks ? 1 : 0; at <= size && size < sbus::GroupSizeMax; at += pitch) {
      Bytes impaired = group.characters;
      impaired.insert(impaired.begin() + at, static_cast<uint8_t>(random()));
      slots[2] += group.size;
      read[2] += group.read(impaired, wrong[2]);
    }
  }
  CHECK(wrong[0] == 0);
  CHECK(wrong[1] * 400 < read[1]);  // of data that are IDs so often
  CHECK(wrong[2] == 0);
  CHECK(read[0] * 10 > slots[0] * 6);
  CHECK(read[1] * 10 > slots[1] * 4);
  CHECK(read[2] * 10 > slots[2] * 7);
}

TEST_CASE("a group before a frame that was rejected is read up to the header") {
  const auto read = [](Bytes characters) {
    characters.resize(sbus::GroupSizeMax + 1, 0x55);
    sbus::SlotData data[8];
    return unsigned{sbus::wholeSlots(0x04, true, characters.data(), sbus::GroupSizeMax + 1, 0x83, 0, data)};
  };
  CHECK(read({0x03, 1, 2, 0x83, 3, 4, 0xE3, 5, 6, 0x0F}) == 0x83);
  CHECK(read({0x03, 1, 2, 0x83, 3, 4, 0xE3, 5, 6, 0x55}) == 0x03);     // the header is missing
  CHECK(read({0x03, 1, 2, 0x83, 3, 4, 0xE3, 5, 0x0F, 0x0F}) == 0x03);  // slot 7 may have lost a character
  CHECK(read({0x03, 1, 2, 0x83, 3, 0xE3, 5, 6, 0x0F}) == 0x01);
  CHECK(read({0x03, 1, 0x83, 3, 4, 0xE3, 5, 6, 0x0F}) == 0x00);
}
