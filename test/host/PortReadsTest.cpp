// Single reads of a USB adapter: what they prove about the gaps on a line, and which frames are found by them.
#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "impairment/ImpairedLine.h"
#include "impairment/Settings.h"
#include "support/AdapterProgram.h"
#include "support/Bytes.h"

namespace {

const uint64_t Seed = seedOfDay();

}  // namespace

TEST_CASE("a recording has what two reads brought on two lines, even if it came back to back") {
  line::PortReads reads;
  line::RecordingWriter writer;
  reads.empty(100000);
  for (const uint64_t us : {uint64_t{101000}, uint64_t{101120}}) {
    reads.begin(2, us);
    writer.put(reads.next(0x0F));
    writer.put(reads.next(0xE5, true));
  }
  writer.finish();
  CHECK(writer.take() == "100880~19000 0F E5!\n101120~19120 0F E5!\n");
}

TEST_CASE(
    "after a stall of 3 s the reads that follow each other at once bring each character 1 us after the last one") {
  line::PortReads reads;
  reads.empty(1000000);
  uint64_t lastUs = 0;
  for (unsigned read = 0; read < 32; read++) {
    reads.begin(256, 4000000, 16000);
    for (unsigned i = 0; i < 256; i++) {
      const uint64_t us = reads.next(0x0F).endUs;
      CHECK(us > lastUs);
      lastUs = us;
    }
  }
  CHECK(lastUs < 4016000 + 32 * 256);
  reads.empty(4001000);
  reads.begin(25, 4100000, 16000);
  CHECK(reads.next(0x0F).endUs == 4100000 - 24 * line::CharacterUs);
}

// Its frame's last 25 bytes look like one of 16 channels.
TEST_CASE("24 channels whose tenth payload byte is a header, at 16 ms, are taken for 16 channels on few lines") {
  CAPTURE(Seed);
  unsigned mistaken = 0;
  for (unsigned number = 0; number < 300; number++) {
    line::Random random(Seed + number);
    std::vector<uint8_t> bytes(36);
    std::generate_n(bytes.begin() + 1, 33, [&random] { return random.byte(); });
    bytes[0] = bytes[11] = sbus::HeaderByte;
    Program program(16000, 0, random);
    size_t frames16 = 0;
    size_t frames24 = 0;
    program.observer.listen([&](const Stretch &stretch) {
      frames16 += stretch.kind == Stretch::Kind::Frame;
      frames24 += stretch.kind == Stretch::Kind::Frame24;
    });
    const size_t skipped = random.below(36);
    for (size_t i = skipped; i < 40 * bytes.size(); i++) {
      Character character;
      character.endUs = i / 36 * 9000 + (i % 36 + 1) * line::CharacterUs;
      character.value = bytes[i % 36];
      program.put(character);
    }
    program.idleUntil(500000);
    program.observer.finish();
    mistaken += frames16 != 0 || frames24 + 12 < 39;
  }
  CHECK(mistaken <= 12);  // 14 of 3000 lines: one run in a million has more than 12
}

TEST_CASE(
    "an adapter is pulled within a frame and plugged in again: the two parts are no frame if reads prove the silence") {
  const struct {
    uint32_t latencyUs;
    uint32_t silenceUs;
  } rows[] = {{1000, 10000}, {16000, 40000}, {16000, 500000}};
  for (const auto &row : rows) {
    CAPTURE(row.latencyUs);
    CAPTURE(row.silenceUs);
    line::Random random(Seed);
    Program program(row.latencyUs, 0, random);
    size_t frames = 0;
    program.observer.listen([&](const Stretch &stretch) { frames += stretch.isFrame(); });
    PayloadFrames sticks(Payload::Smooth, random);
    uint64_t us = 20000;
    const auto send = [&](size_t from, size_t to) {
      const Frame frame = sticks.next();
      for (size_t i = from; i < to; i++) {
        Character character;
        character.endUs = us += line::CharacterUs;
        character.value = frame[i];
        program.put(character);
      }
    };
    for (int i = 0; i < 20; i++, us += 6000) {
      send(0, sbus::FrameSize);
    }
    send(0, 12);
    us += row.silenceUs;
    send(12, sbus::FrameSize);
    for (int i = 0; i < 20; i++) {
      us += 6000;
      send(0, sbus::FrameSize);
    }
    program.idleUntil(us + 500000);
    program.observer.finish();
    CHECK(frames == 40);
    CHECK(program.observer.counters().discardedBytes == sbus::FrameSize);
  }
}

TEST_CASE("an impaired frame in the first read of a port that was never found empty is one stretch, with its reason") {
  line::Random random(Seed);
  PayloadFrames sticks(Payload::Neutral, random);
  const Frame good = sticks.next();
  const Bytes bytes = join({good, good, good}) + without(good, 5) + join({good, good});
  line::Observer observer;
  std::vector<Stretch> others;
  size_t frames = 0;
  observer.listen([&](const Stretch &stretch) {
    frames += stretch.isFrame();
    if (!stretch.isFrame()) {
      others.push_back(stretch);
    }
  });
  line::PortReads reads;
  reads.begin(bytes.size(), 1000000);
  for (const uint8_t byte : bytes) {
    observer.put(reads.next(byte));
  }
  observer.finish();
  CHECK(frames == 5);
  REQUIRE(others.size() == 1);
  CHECK(others[0].characters.size() == sbus::FrameSize - 1);
  CHECK(why(others[0]) == "no end byte");
}
