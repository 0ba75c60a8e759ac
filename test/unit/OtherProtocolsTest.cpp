// Which protocol the bytes of a port belong to: 400 packets of each are named, and no random bytes are.
#include <doctest/doctest.h>

#include <cstdint>
#include <functional>
#include <numeric>
#include <random>
#include <vector>

#include "sbus/OtherProtocols.h"
#include "support/Feed.h"

namespace {

using sbus::Finding;
using sbus::OtherProtocols;

constexpr unsigned Seed = 20181;
constexpr unsigned Packets = 400;

// The checksums are written here bit by bit, other than in the library.
uint32_t crc(const Bytes &bytes, size_t from, unsigned bits, uint32_t polynomial) {
  uint32_t value = 0;
  for (size_t i = from; i < bytes.size(); i++) {
    for (int bit = 7; bit >= 0; bit--) {
      const bool top = (value >> (bits - 1) & 1) != (bytes[i] >> bit & 1u);
      value = (value << 1) & ((1u << bits) - 1);
      value ^= top ? polynomial : 0;
    }
  }
  return value;
}

Bytes iBus(const std::vector<unsigned> &sticks) {
  Bytes bytes = {0x20, 0x40};
  for (unsigned i = 0; i < 14; i++) {
    const unsigned us = 1000 + sticks[i % sticks.size()] * 1000 / 2047;
    bytes.insert(bytes.end(), {static_cast<uint8_t>(us), static_cast<uint8_t>(us >> 8)});
  }
  const unsigned sum = 0xFFFFu - std::accumulate(bytes.begin(), bytes.end(), 0u);
  bytes.insert(bytes.end(), {static_cast<uint8_t>(sum), static_cast<uint8_t>(sum >> 8)});
  return bytes;
}

// 16 channels of 11 bits, the lowest first.
Bytes packed(const std::vector<unsigned> &sticks) {
  Bytes bytes(22);
  for (unsigned bit = 0; bit < 176; bit++) {
    const unsigned stick = sticks[bit / 11 % sticks.size()];
    bytes[bit / 8] = static_cast<uint8_t>(bytes[bit / 8] | (stick >> bit % 11 & 1u) << bit % 8);
  }
  return bytes;
}

Bytes crsf(const std::vector<unsigned> &sticks) {
  Bytes bytes = {0xC8, 24, 0x16};
  const Bytes channels = packed(sticks);
  bytes.insert(bytes.end(), channels.begin(), channels.end());
  bytes.push_back(static_cast<uint8_t>(crc(bytes, 2, 8, 0xD5)));
  return bytes;
}

Bytes crsfStatistics() {
  Bytes bytes = {0xC8, 12, 0x14, 30, 31, 100, 5, 0, 1, 2, 40, 99, 7};
  bytes.push_back(static_cast<uint8_t>(crc(bytes, 2, 8, 0xD5)));
  return bytes;
}

Bytes sumd(const std::vector<unsigned> &sticks) {
  Bytes bytes = {0xA8, 0x01, 12};
  for (unsigned i = 0; i < 12; i++) {
    const unsigned value = 8800 + 3 * sticks[i % sticks.size()];
    bytes.insert(bytes.end(), {static_cast<uint8_t>(value >> 8), static_cast<uint8_t>(value)});
  }
  const uint32_t sum = crc(bytes, 0, 16, 0x1021);
  bytes.insert(bytes.end(), {static_cast<uint8_t>(sum >> 8), static_cast<uint8_t>(sum)});
  return bytes;
}

Bytes escaped(const Bytes &bytes) {
  unsigned sum = std::accumulate(bytes.begin(), bytes.end(), 0u);
  while (sum > 0xFF) {
    sum = (sum & 0xFF) + (sum >> 8);
  }
  Bytes all = bytes;
  all.push_back(static_cast<uint8_t>(0xFF - sum));
  Bytes result = {0x7E};
  for (const uint8_t byte : all) {
    if (byte == 0x7E || byte == 0x7D) {
      result.insert(result.end(), {0x7D, static_cast<uint8_t>(byte ^ 0x20)});
    } else {
      result.push_back(byte);
    }
  }
  result.push_back(0x7E);
  return result;
}

Bytes fPort(const std::vector<unsigned> &sticks) {
  Bytes bytes = {0x19, 0x00};
  const Bytes channels = packed(sticks);
  bytes.insert(bytes.end(), channels.begin(), channels.end());
  bytes.insert(bytes.end(), {0x00, 90});
  bytes = escaped(bytes);
  const Bytes telemetry = escaped({0x08, 0x01, 0x00, 0, 0, 0, 0, 0, 0});
  bytes.insert(bytes.end(), telemetry.begin(), telemetry.end());
  return bytes;
}

Bytes spektrum(const std::vector<unsigned> &sticks, unsigned packet, uint8_t system) {
  Bytes bytes = {0, system};
  const unsigned bits = system == 0x01 ? 10 : 11;
  for (unsigned i = 0; i < 7; i++) {
    const unsigned channel = packet % 2 * 5 + i;
    const unsigned value = sticks[channel % sticks.size()] >> (11 - bits);
    const unsigned word = channel << bits | value | (i == 0 && packet % 2 != 0 ? 0x8000u : 0);
    bytes.insert(bytes.end(), {static_cast<uint8_t>(word >> 8), static_cast<uint8_t>(word)});
  }
  return bytes;
}

// DJI's DR16: sticks of 11 bits from 364 to 1684, switches 1 to 3, no mouse, no key, the wheel centred.
Bytes dbus(const std::vector<unsigned> &sticks, unsigned packet) {
  Bytes bytes(18);
  for (unsigned bit = 0; bit < 44; bit++) {
    const unsigned stick = 364 + sticks[bit / 11] * 1320 / 2047;
    bytes[bit / 8] = static_cast<uint8_t>(bytes[bit / 8] | (stick >> bit % 11 & 1u) << bit % 8);
  }
  bytes[5] = static_cast<uint8_t>(bytes[5] | (1 + packet % 3) << 4 | (1 + packet / 3 % 3) << 6);
  bytes[12] = packet % 2;
  bytes[17] = 0x04;
  return bytes;
}

Finding foundIn(const Bytes &bytes) {
  OtherProtocols protocols;
  for (const uint8_t byte : bytes) {
    protocols.put(byte);
  }
  return protocols.found();
}

}  // namespace

TEST_CASE("DBUS has sticks between their ends, switches that stand somewhere, and buttons that are pressed or not") {
  const struct {
    const char *what;
    size_t at;
    uint8_t mask, bits;
    Finding finding;
  } rows[] = {
      {"as it is", 5, 0x00, 0x00, Finding::Dbus},
      {"no first switch", 5, 0x30, 0x00, Finding::NoSignal},
      {"no second switch", 5, 0xC0, 0x00, Finding::NoSignal},
      {"a button of 2", 12, 0xFF, 0x02, Finding::NoSignal},
      {"another of 2", 13, 0xFF, 0x02, Finding::NoSignal},
      {"a stick at 0", 0, 0xFF, 0x00, Finding::NoSignal},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    std::mt19937 random(Seed);
    Bytes bytes;
    for (unsigned i = 0; i < 100; i++) {
      const auto stick = [&random] { return static_cast<unsigned>(random() % 2048); };
      Bytes packet = dbus({stick(), stick(), stick(), stick()}, i);
      packet[1] = row.at == 0 ? static_cast<uint8_t>(packet[1] & 0xF8) : packet[1];
      packet[row.at] = static_cast<uint8_t>((packet[row.at] & ~row.mask) | row.bits);
      bytes.insert(bytes.end(), packet.begin(), packet.end());
    }
    CHECK(foundIn(bytes) == row.finding);
  }
}

TEST_CASE("400 packets of each protocol are named, wherever they are joined; they hold no frame of S.Bus") {
  std::mt19937 random(Seed);
  CAPTURE(Seed);
  const struct {
    const char *what;
    Finding finding;
    std::function<Bytes(const std::vector<unsigned> &, unsigned)> packet;
  } rows[] = {
      {"i-BUS", Finding::IBus, [](const auto &sticks, unsigned) { return iBus(sticks); }},
      {"CRSF", Finding::Crsf,
       [](const auto &sticks, unsigned i) { return i % 10 == 9 ? crsfStatistics() : crsf(sticks); }},
      {"SUMD", Finding::Sumd, [](const auto &sticks, unsigned) { return sumd(sticks); }},
      {"F.Port", Finding::FPort, [](const auto &sticks, unsigned) { return fPort(sticks); }},
      {"DBUS", Finding::Dbus, [](const auto &sticks, unsigned i) { return dbus(sticks, i); }},
      {"Spektrum, 1024", Finding::Spektrum, [](const auto &sticks, unsigned i) { return spektrum(sticks, i, 0x01); }},
      {"Spektrum, 2048", Finding::Spektrum, [](const auto &sticks, unsigned i) { return spektrum(sticks, i, 0xA2); }},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    Bytes bytes;
    std::vector<unsigned> sticks(16, 992);
    Feeder port;
    size_t frames = 0;
    for (unsigned i = 0; i < Packets; i++) {
      sticks[i % 4] = static_cast<unsigned>(random() % 2048);
      const Bytes packet = row.packet(sticks, i);
      bytes.insert(bytes.end(), packet.begin(), packet.end());
      frames += port.feed(packet).size() + port.wait(4000).waited.size();
    }
    CHECK(frames == 0);
    for (const size_t from : {size_t{0}, size_t{1}, size_t{7}, size_t{30}}) {
      CAPTURE(from);
      CHECK(foundIn({bytes.begin() + static_cast<std::ptrdiff_t>(from), bytes.end()}) == row.finding);
    }
    // One byte in a hundred is wrong or missing.
    Bytes damaged;
    for (const uint8_t byte : bytes) {
      if (random() % 100 != 0) {
        damaged.push_back(byte);
      } else if (random() % 2 == 0) {
        damaged.push_back(static_cast<uint8_t>(random()));
      }
    }
    CHECK(foundIn(damaged) == row.finding);
    // Packets with a byte between them are chance, however many come.
    Bytes apart;
    for (unsigned i = 0; i < Packets; i++) {
      apart = apart + row.packet(sticks, i) + Bytes{0x55};
    }
    CHECK(foundIn(apart) == Finding::NoSignal);
  }
}

TEST_CASE("random bytes, and frames of S.Bus, are not named") {
  std::mt19937 random(Seed);
  CAPTURE(Seed);
  Bytes bytes;
  for (unsigned i = 0; i < 200000; i++) {
    bytes.push_back(static_cast<uint8_t>(random()));
  }
  CHECK(foundIn(bytes) == Finding::NoSignal);
  for (uint8_t &byte : bytes) {  // bytes that begin packets
    const uint8_t likely[] = {0x20, 0x40, 0xC8, 0x16, 0x18, 0x7E, 0x19, 0x00, 0xA8, 0x01, 0x0C, 0xA2};
    byte = random() % 2 == 0 ? likely[random() % sizeof likely] : byte;
  }
  CHECK(foundIn(bytes) == Finding::NoSignal);
  CHECK(foundIn(Bytes(100000, 0x00)) == Finding::NoSignal);
  CHECK(foundIn(Bytes(100000, 0xFF)) == Finding::NoSignal);
  bytes.clear();
  for (unsigned i = 0; i < 4000; i++) {
    uint16_t channels[sbus::ChannelCount];
    for (uint16_t &channel : channels) {
      channel = static_cast<uint16_t>(random() % 2048);
    }
    channels[16] = channels[17] = 0;
    uint8_t frame[sbus::FrameSize];
    sbus::pack(frame, channels, false, false);
    bytes.insert(bytes.end(), frame, frame + sbus::FrameSize);
  }
  CHECK(foundIn(bytes) == Finding::NoSignal);
}
