// What the bytes of a line show beside its frames: packets of one length that are no frames, and the lost-frame flag's
// rhythm. By a list of packets, and by a FrameFinder on a line.
#include <doctest/doctest.h>

#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "sbus/FlagRhythm.h"
#include "sbus/PacketShape.h"
#include "sbus/Symptoms.h"
#include "support/Feed.h"
#include "support/KnownFrames.h"

namespace {

using sbus::Finding;
using sbus::FlagRhythm;
using sbus::PacketShape;
using sbus::Symptoms;

constexpr unsigned Seed = 20181;
constexpr unsigned Least = 12;

Bytes frame() { return bytesOf(Neutral.bytes); }
Bytes changed(size_t at, uint8_t byte) {
  Bytes bytes = frame();
  bytes[at] = byte;
  return bytes;
}

void feed(PacketShape &shape, const Bytes &packet) {
  for (const uint8_t byte : packet) {
    shape.put(byte);
  }
  shape.gap();
}

// `count` packets, each of which may depend on its number, after the rest of one.
PacketShape shapeOf(unsigned count, const std::function<Bytes(unsigned)> &packet) {
  PacketShape shape;
  feed(shape, {0x55});
  for (unsigned i = 0; i < count; i++) {
    feed(shape, packet(i));
  }
  return shape;
}

}  // namespace

TEST_CASE("twelve packets of one length and with one first byte are a finding, unless they are frames") {
  const struct {
    const char *what;
    std::function<Bytes(unsigned)> packet;
    Finding finding;
  } rows[] = {
      {"frames", [](unsigned) { return frame(); }, Finding::NoSignal},
      {"frames of S.BUS2", [](unsigned i) { return changed(24, static_cast<uint8_t>(i % 4 << 4 | 4)); },
       Finding::NoSignal},
      {"frames of FASSTest 26", [](unsigned i) { return changed(0, i % 2 == 0 ? 0x2F : 0x0F); }, Finding::NoSignal},
      {"frames and tails of an R7003SB",
       [](unsigned) {
         return changed(24, 8) + Bytes{0, 3, 0xC0, 0x33, 0};
       },
       Finding::NoSignal},
      {"frames of 24 channels", [](unsigned) { return bytesOf(Published24.bytes); }, Finding::NoSignal},
      {"header F0", [](unsigned) { return changed(0, 0xF0); }, Finding::WrongPackets},
      {"end byte 55", [](unsigned) { return changed(24, 0x55); }, Finding::WrongPackets},
      {"24 bytes", [](unsigned) { return part(frame(), 0, 24); }, Finding::WrongPackets},
      {"5 bytes", [](unsigned) { return part(frame(), 0, 5); }, Finding::WrongPackets},
      {"slots of 3 bytes",
       [](unsigned) {
         return Bytes{3, 0xC0, 0x2E};
       },
       Finding::NoSignal},
      {"64 bytes", [](unsigned) { return Bytes(64, 0x55); }, Finding::WrongPackets},
      {"65 bytes", [](unsigned) { return Bytes(65, 0x55); }, Finding::NoSignal},
      {"300 bytes", [](unsigned) { return Bytes(300, 0x55); }, Finding::NoSignal},
      {"24 channels, a wrong end byte", [](unsigned) { return part(bytesOf(Published24.bytes), 0, 35) + Bytes{0x55}; },
       Finding::WrongPackets},
      {"flags 30", [](unsigned) { return changed(23, 0x30); }, Finding::UnusedFlags},
      {"flags 80, then 10", [](unsigned i) { return changed(23, i % 2 == 0 ? 0x80 : 0x10); }, Finding::UnusedFlags},
      {"flags 10, end byte 55", [](unsigned) { return part(changed(23, 0x10), 0, 24) + Bytes{0x55}; },
       Finding::WrongPackets},
      {"another first byte each time", [](unsigned i) { return changed(0, static_cast<uint8_t>(0x70 + i)); },
       Finding::NoSignal},
      {"another length each time", [](unsigned i) { return Bytes(10 + i % 2, 0x0F); }, Finding::NoSignal},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    CHECK(shapeOf(Least, row.packet).found() == row.finding);
    CHECK(shapeOf(Least - 1, row.packet).found() == Finding::NoSignal);
  }
}

TEST_CASE("a packet of another length, a wrong byte or a frame breaks the row; good flags and slots do not") {
  const Bytes shorter = part(frame(), 0, 24);
  const struct {
    const char *what;
    Bytes packet, between;
    Finding finding;
  } rows[] = {
      {"a packet of 23 bytes", shorter, part(shorter, 0, 23), Finding::NoSignal},
      {"a frame", shorter, frame(), Finding::NoSignal},
      {"a slot", shorter, {3, 0xC0, 0x2E}, Finding::WrongPackets},
      {"frames among wrong flags", changed(23, 0x30), frame(), Finding::UnusedFlags},
      {"frames among wrong headers", changed(0, 0xF0), frame(), Finding::NoSignal},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    CHECK(shapeOf(2 * Least, [&](unsigned i) { return i % 3 == 2 ? row.between : row.packet; }).found() == row.finding);
  }
  PacketShape shape = shapeOf(Least - 1, [&](unsigned) { return shorter; });
  shape.spoil();
  feed(shape, shorter);
  CHECK(shape.found() == Finding::NoSignal);
  shape.gap();  // likewise
  for (unsigned i = 0; i < Least; i++) {
    CHECK(shape.found() == Finding::NoSignal);
    feed(shape, shorter);
  }
  CHECK(shape.found() == Finding::WrongPackets);
  CHECK(unsigned{shape.form().size} == 24);
  CHECK(unsigned{shape.form().first} == 0x0F);
  CHECK(unsigned{shape.form().last} == 0x00);
  CHECK(unsigned{shapeOf(Least, [](unsigned) { return changed(23, 0x30); }).form().flags} == 0x30);
}

TEST_CASE("a noisy line that loses bytes is no row of packets of one length") {
  std::mt19937 random(Seed);
  CAPTURE(Seed);
  for (const unsigned one : {300u, 50u, 12u}) {
    CAPTURE(one);
    const PacketShape shape = shapeOf(20000, [&](unsigned) {
      Bytes bytes;
      for (const uint8_t byte : frame()) {
        if (random() % one != 0) {
          bytes.push_back(byte);
        }
      }
      return bytes;
    });
    CHECK(shape.found() == Finding::NoSignal);
  }
}

TEST_CASE("a lost-frame flag in turn, as the radio's packets come; and at random") {
  std::mt19937 random(Seed);
  CAPTURE(Seed);
  const struct {
    const char *what;
    std::function<bool(unsigned)> isLost;
    unsigned frames;  // until it is known; 0: it is not
  } rows[] = {
      {"never", [](unsigned) { return false; }, 0},
      {"always", [](unsigned) { return true; }, 0},
      {"every second", [](unsigned i) { return i % 2 != 0; }, 20},
      {"every third", [](unsigned i) { return i % 3 == 2; }, 30},
      {"50 packets a second, 111 frames", [](unsigned i) { return i > 0 && i * 50 / 111 == (i - 1) * 50 / 111; }, 22},
      {"at random, half of them", [&](unsigned) { return random() % 2 != 0; }, 0},
      {"at random, one in ten", [&](unsigned) { return random() % 10 == 0; }, 0},
      {"at random, nine in ten", [&](unsigned) { return random() % 10 != 0; }, 0},
      {"one second in two", [](unsigned i) { return i / 111 % 2 != 0; }, 2110},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    FlagRhythm rhythm;
    unsigned known = 0;
    for (unsigned i = 0; i < 5000; i++) {
      rhythm.put(row.isLost(i));
      known = known == 0 && rhythm.isSteady() ? i + 1 : known;
    }
    CHECK(known == row.frames);
    CHECK(rhythm.isSteady() == (row.frames != 0));
  }
  FlagRhythm rhythm;
  for (unsigned i = 0; i < 400; i++) {
    rhythm.put(i % 2 != 0 || i % 100 == 50);  // a packet was lost: one in 16 may be
  }
  CHECK(rhythm.isSteady());
  for (unsigned i = 0; i < 400; i++) {
    rhythm.put(i % 2 != 0 || i % 10 == 4);
  }
  CHECK_FALSE(rhythm.isSteady());
}

TEST_CASE("a FrameFinder tells of packets, protocols, no pulses and the flag's rhythm") {
  using SymptomsFeeder = FeederOf<sbus::Frame16Extra, Symptoms>;
  const struct {
    const char *what;
    std::function<Bytes(unsigned)> packet;
    Finding finding;
    uint32_t pulseless;
  } rows[] = {
      {"frames", [](unsigned) { return frame(); }, Finding::NoSignal, 0},
      {"frames of FASSTest 26", [](unsigned i) { return changed(0, i % 2 == 0 ? 0x2F : 0x0F); }, Finding::NoSignal, 0},
      {"S.BUS2",
       [](unsigned) {
         return changed(24, 4) + Bytes{3, 0xC0, 0x2E};
       },
       Finding::NoSignal, 0},
      {"24 bytes", [](unsigned) { return part(frame(), 0, 24); }, Finding::WrongPackets, 0},
      {"23 bytes", [](unsigned) { return part(frame(), 0, 23); }, Finding::WrongPackets, 0},
      {"12 bytes", [](unsigned) { return part(frame(), 0, 12); }, Finding::WrongPackets, 0},
      {"header F0", [](unsigned) { return changed(0, 0xF0); }, Finding::WrongPackets, 0},
      {"flags 30, now and then", [](unsigned i) { return changed(23, i % 3 == 0 ? 0x30 : 0); }, Finding::UnusedFlags,
       0},
      {"every second frame lost", [](unsigned i) { return changed(23, i % 2 == 0 ? 4 : 0); }, Finding::LostInTurn, 0},
      {"no pulses", [](unsigned) { return Bytes{0x0F} + Bytes(24, 0); }, Finding::NoSignal, 40},
      {"no pulses in failsafe",
       [](unsigned) {
         return Bytes{0x0F} + Bytes(22, 0) + Bytes{8, 0};
       },
       Finding::NoSignal, 0},
      {"0 on CH1 to CH4 but for a bit", [](unsigned) { return Bytes{0x0F} + Bytes(5, 0) + Bytes{8} + Bytes(18, 0); },
       Finding::NoSignal, 0},
      {"i-BUS",
       [](unsigned) {
         return Bytes{0x20, 0x40} + Bytes{0xDC, 5, 0xDC, 5, 0xDC, 5, 0xDC, 5, 0xDC, 5, 0xDC, 5, 0xDC, 5} +
                Bytes{0xDC, 5, 0xDC, 5, 0xDC, 5, 0xDC, 5, 0xDC, 5, 0xDC, 5, 0xDC, 5} + Bytes{0x51, 0xF3};
       },
       Finding::IBus, 0},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    SymptomsFeeder feeder;
    for (unsigned i = 0; i < 40; i++) {
      feeder.feed(row.packet(i));
      feeder.wait(4000);
    }
    CHECK(feeder.finder.events().found() == row.finding);
    CHECK(feeder.finder.events().pulseless() == row.pulseless);
    feeder.finder.reset(feeder.now, 120);
    CHECK(feeder.finder.events().found() == Finding::NoSignal);
    CHECK(feeder.finder.events().pulseless() == 0);
  }
  SymptomsFeeder feeder;  // packets that are one second apart: each silence is longer than any frame period
  for (unsigned i = 0; i < 40; i++) {
    feeder.feed(part(frame(), 0, 24));
    for (unsigned ms = 0; ms < 1000; ms++) {
      feeder.wait(1000);
    }
  }
  CHECK(feeder.finder.events().found() == Finding::WrongPackets);
}
