#include "Lines.h"

#include "support/KnownFrames.h"
#include "support/Random.h"

namespace {

using Pattern = std::vector<uint8_t>;

Pattern operator+(Pattern left, const Pattern &right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

Pattern random() {
  Random random(20181);
  Pattern bytes(4096);
  for (uint8_t &byte : bytes) {
    byte = random.byte();
  }
  return bytes;
}

// Of the lines with the worst calls: where every header may begin a frame, and few do.
Pattern runs() {
  Random random(1);
  Pattern bytes;
  while (bytes.size() < 4096) {
    bytes = bytes + Pattern(1 + random.below(40), 0x0F);
    const uint8_t ends[] = {0x00, 0x00, 0x00, 0x04, 0x08, 0x14};
    bytes = bytes + Pattern(1 + random.below(40), ends[random.below(6)]);
  }
  return bytes;
}

Pattern neutral(uint8_t flags, uint8_t end) {
  Pattern bytes(Neutral.bytes.begin(), Neutral.bytes.end());
  bytes[23] = flags;
  bytes[24] = end;
  return bytes;
}

Pattern without(Pattern bytes, size_t index) {
  bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(index));
  return bytes;
}

Pattern with(Pattern bytes, size_t index, uint8_t byte) {
  bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(index), byte);
  return bytes;
}

std::vector<BadLine> make() {
  const Pattern frame = neutral(0x00, 0x00);
  return {
      {"random bytes", random()},
      {"runs of 0F and of end bytes", runs()},
      {"0F without end", {0x0F}},
      {"0F 00 in turn", {0x0F, 0x00}},
      {"24 of 0F, 24 of 0C: none of 24 headers has an end byte", Pattern(24, 0x0F) + Pattern(24, 0x0C)},
      {"24 of 0F, 24 of 00: each of them has, and flags", Pattern(24, 0x0F) + Pattern(24, 0x00)},
      {"24 of 0F, 24 of 04: and a byte too many", Pattern(24, 0x0F) + Pattern(24, 0x04)},
      {"neutral frames without a pause", frame},
      {"neutral frames with end byte 0C", neutral(0x00, 0x0C)},
      {"neutral frames with flags 10", neutral(0x10, 0x00)},
      {"neutral frames that lack a byte", without(frame, 12)},
      {"neutral frames with a byte too many", with(frame, 12, 0x0F)},
      {"neutral frames, a telemetry answer after each", neutral(0x00, 0x04) + Pattern{0x03, 0xC0, 0x2E}},
  };
}

}  // namespace

const std::vector<BadLine> &badLines() {
  static const std::vector<BadLine> all = make();
  return all;
}

const WorstCall WorstCalls[4] = {
    {20, 333,
     "0F 04 0F 0F 0F 0F 0F 0F 0F 0C 0F FF 0F 0F 0F 00 0F 0F 0F 04 0F 0F 0F 0C 04 0F 10 00 0F 0F 0C 0F 0F 0F 0F 0F 0F "
     "0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 08 0F 08 04 08 04 08 08 | "
     "04 08 08 04 08 04 08 04 08 04 04 04 04 04 04 04"},
    {6, 3747,
     "04 08 34 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 08 00 08 08 00 | "
     "08 00 08 00 08 08 08 00 08 08 00 08 00 08 08 00 08 04 08 FF 04 04 04 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F "
     "0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 08"},
    {28, 333,
     "0F 0F 00 0F 0F 0F 0F 0F FF 08 0F 0F 0F 00 2F 0C 0F 00 0F 0F 0F 0F 00 0F 08 | "
     "08 0F 0F 0F 0F 08 08 0F 0F 08 0F 08 0F 34 0F 00 0C 08 08 00 08 00 00 08 08 04 08 00 08 00 0F 00 08 08 08 04 08 "
     "00 0F FF 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 04 2F"},
    // The worst if a poll's search did not end after 24 refused headers.
    {20, 333,
     "0F 0C 0F FF 0F 0F 0F 00 0F 0F 0F 04 0F 0F 0F 0C 0C 04 0F 00 0F 0F 0C 08 04 0F 0F 0F 0F 0F 0F 0F 0F 00 0F 00 "
     "0F 0F 0F 0F 0F 0F 0F 0F 00 0F 0F 0F 0F 08 08 0F 08 0F | "
     "04 08 00 0F 00 0F 00 08 0F 0F 0F 0F 0F 00 0F 0F 0F 0F 08 0F 0F 08 0F 0F 0F 0F 0F 08 0F 0F 0F 0F 0F 0F 0F 08 "
     "00 0F 04 08 04 08 08 08 04 0C 04 04 08 04 08 FF 0F 08 04 08 04 08 04 FF 0C 04 FF 10"},
};
