// What is between the edges of a line: characters, whatever the edges are like, and nothing that is not on the line.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "port/EdgeDecoder.h"

namespace {

using sbus::EdgeDecoder;

// Takes edges, through a ring from any place on.
void take(EdgeDecoder &decoder, const std::vector<uint8_t> &edges) {
  static uint8_t from = 0;
  uint8_t ring[256] = {};
  const uint8_t to = static_cast<uint8_t>(from + edges.size());
  for (size_t i = 0; i < edges.size(); i++) {
    ring[static_cast<uint8_t>(from + i)] = edges[i];
  }
  while (from != to) {
    from = decoder.take<sbus::PlainEdges>(ring, from, to);
  }
}

constexpr double TicksPerUs = 2;

// A line: times of its edges, us. The first one rises.
struct Wave {
  std::vector<double> edges;
  double us = 1000;

  void change(bool isHigh, double at) {
    if (isHigh != (edges.size() % 2 != 0)) {
      edges.push_back(at);
    }
  }
  void character(uint8_t value, double bitUs = 10, bool isParityWrong = false, double slowUs = 0) {
    const unsigned parity = (static_cast<unsigned>(__builtin_parity(value)) ^ (isParityWrong ? 1u : 0u)) & 1u;
    const unsigned bits = unsigned{value} << 1 | parity << 9 | 3u << 10;
    for (unsigned bit = 0; bit < 12; bit++) {
      const bool isHigh = (bits >> bit & 1) == 0;
      change(isHigh, us + bit * bitUs + (isHigh ? slowUs : 0));
    }
    us += 12 * bitUs;
  }
  // Inverts the line for a while.
  void pulse(double at, double width) {
    for (const double edge : {at, at + width}) {
      const auto same = std::find(edges.begin(), edges.end(), edge);
      if (same != edges.end()) {
        edges.erase(same);
      } else {
        edges.insert(std::upper_bound(edges.begin(), edges.end(), edge), edge);
      }
    }
  }
};

// As the interrupt notes them: times in ticks, and what the line has been for 256 ticks or more.
std::vector<uint8_t> noted(const Wave &wave, bool rises = true) {
  std::vector<uint8_t> all;
  int64_t last = -100000;
  for (const double us : wave.edges) {
    const int64_t now = static_cast<int64_t>(us * TicksPerUs), ticks = now - last;
    all.push_back(ticks < 256 ? static_cast<uint8_t>(ticks) : rises ? sbus::edge::LongRise : sbus::edge::LongFall);
    last = now;
    rises = !rises;
  }
  return all;
}

struct Result {
  std::vector<unsigned> characters;
  bool isLost = false;
};

// Takes the edges, up to `most` at once, and reads each time what is there. At the end the line idles.
Result decoded(const std::vector<uint8_t> &edges, bool inverted = true, size_t most = 255) {
  EdgeDecoder decoder;
  decoder.begin(inverted);
  Result result;
  for (size_t i = 0; i < edges.size();) {
    const size_t end = std::min(edges.size(), i + most);
    const std::vector<uint8_t> part(edges.data() + i, edges.data() + end);  // a copy: nothing beyond it may be read
    take(decoder, part);
    i = end;
    if (i == edges.size()) {
      decoder.idle(1000);
    }
    while (decoder.available() != 0) {
      const int peeked = decoder.isReady() ? decoder.peek() : -1, character = decoder.read();
      CHECK(character == peeked);
      if (character < 0) {
        result.isLost = true;
      } else {
        result.characters.push_back(static_cast<unsigned>(character));
      }
    }
  }
  return result;
}

using Characters = std::vector<unsigned>;

}  // namespace

TEST_CASE("all characters come through: at 97 to 103 kbaud, in pieces of any size, inverted or not") {
  for (const double bitUs : {1000 / 97.0, 10.0, 1000 / 103.0}) {
    for (const size_t most : {size_t{1}, size_t{2}, size_t{7}, size_t{255}}) {
      for (const bool inverted : {true, false}) {
        CAPTURE(bitUs);
        CAPTURE(most);
        CAPTURE(inverted);
        for (unsigned first = 0; first < 256; first += 16) {
          Wave wave;
          Characters sent;
          for (unsigned value = first; value < first + 16; value++) {
            wave.character(static_cast<uint8_t>(value), bitUs);
            sent.push_back(value);
          }
          const Result result = decoded(noted(wave, inverted), inverted, most);
          CHECK(result.characters == sent);
          CHECK_FALSE(result.isLost);
        }
      }
    }
  }
}

TEST_CASE("what a wave has become: the characters 55 0F A3, and what is done to the second one") {
  constexpr double Second = 1120;
  struct Row {
    const char *name;
    void (*change)(Wave &wave);
    Characters expected;
  };
  const Row rows[] = {
      {"nothing", [](Wave &) {}, {0x55, 0x0F, 0xA3}},
      {"a pulse of 2.5 us between two edges", [](Wave &wave) { wave.pulse(Second + 63, 2.5); }, {0x55, 0x0F, 0xA3}},
      {"one 6 us after an edge", [](Wave &wave) { wave.pulse(Second + 6.2, 2.5); }, {0x55, 0x0F, 0xA3}},
      {"one in its stop bits", [](Wave &wave) { wave.pulse(Second + 112, 2.5); }, {0x55, 0x0F, 0xA3}},
      {"two pulses in one bit",
       [](Wave &wave) {
         wave.pulse(Second + 61.5, 2);
         wave.pulse(Second + 66, 2);
       },
       {0x55, 0x0F, 0xA3}},
      {"an edge that bounces: 2 us", [](Wave &wave) { wave.pulse(Second + 12, 2); }, {0x55, 0x0F, 0xA3}},
      {"a pulse of 4 us", [](Wave &wave) { wave.pulse(Second + 63, 4); }, {0x55}},
      {"a pulse of 8 us that changes no bit", [](Wave &wave) { wave.pulse(Second + 65, 8); }, {0x55}},
      {"one bit changed", [](Wave &wave) { wave.pulse(Second + 70, 10); }, {0x55, 0xA3}},
      {"no stop bit", [](Wave &wave) { wave.pulse(Second + 100, 20); }, {0x55}},
  };
  for (const Row &row : rows) {
    CAPTURE(std::string(row.name));
    Wave wave;
    wave.character(0x55);
    wave.character(0x0F);
    wave.character(0xA3);
    row.change(wave);
    CHECK(decoded(noted(wave)).characters == row.expected);
    CHECK(decoded(noted(wave), true, 1).characters == row.expected);
  }
}

TEST_CASE("edges that are late by up to 4 us, and levels of unequal length, change nothing") {
  std::mt19937 random{20181};
  for (int round = 0; round < 200; round++) {
    Wave wave;
    Characters sent;
    for (int i = 0; i < 25; i++) {
      sent.push_back(static_cast<uint8_t>(random()));
      wave.character(static_cast<uint8_t>(sent.back()), 10, false, round % 2 != 0 ? 3 : 0);
    }
    if (round % 2 == 0) {
      for (double &us : wave.edges) {
        us += std::uniform_real_distribution<double>(0, 3.5)(random);
      }
    }
    const Result result = decoded(noted(wave), true, 1 + random() % 255);
    CHECK(result.characters == sent);
  }
}

TEST_CASE("a wrong parity bit drops the character, and nothing else") {
  Wave wave;
  wave.character(0x55);
  wave.character(0x0F, 10, true);
  wave.character(0xA3);
  const Result result = decoded(noted(wave));
  CHECK(result.characters == Characters{0x55, 0xA3});
  CHECK_FALSE(result.isLost);
}

TEST_CASE("a character without a stop bit is none, even if its parity fits") {
  for (const double longerUs : {15.0, 25.0, 600.0}) {
    CAPTURE(longerUs);
    Wave wave;
    wave.character(0x07, 10, true);
    wave.pulse(1100, longerUs);
    wave.us += 2000;
    wave.character(0xA3);
    CHECK(decoded(noted(wave)).characters == Characters{0xA3});
  }
}

TEST_CASE("after missed edges nothing counts until the line has idled, and what waits is dropped; the loss is told") {
  Wave wave;
  wave.character(0x55);
  wave.character(0x0F);
  wave.us += 1000;
  wave.character(0xA3);
  std::vector<uint8_t> edges = noted(wave);
  edges[12] = sbus::edge::Missed;
  const Result atOnce = decoded(edges);
  CHECK(atOnce.characters == Characters{0xA3});
  CHECK(atOnce.isLost);
  CHECK(decoded(edges, true, 11).characters == Characters{0x55, 0xA3});
}

TEST_CASE("a line with the other polarity, or one that is high for long, brings nothing") {
  Wave wave;
  for (int i = 0; i < 25; i++) {
    wave.character(0x0F);
  }
  CHECK(decoded(noted(wave, false)).characters.empty());
  CHECK(decoded(noted(wave, true), false).characters.empty());
  Wave stuck;
  stuck.edges = {1000, 1500, 2500, 2600};
  CHECK(decoded(noted(stuck)).characters == Characters{0x00});  // the second pulse, of 100 us, is a character
}

TEST_CASE("characters that nobody reads: the newest remain, and the loss is told") {
  EdgeDecoder decoder;
  decoder.begin(true);
  for (unsigned i = 0; i < EdgeDecoder::Room + 10u; i++) {
    Wave wave;
    wave.character(static_cast<uint8_t>(i));
    const std::vector<uint8_t> edges = noted(wave);
    take(decoder, edges);
    decoder.idle(1000);
  }
  CHECK(decoder.available() == 1);
  CHECK(decoder.read() == -1);
  CHECK(decoder.available() == 10);
  for (int i = 0; i < 10; i++) {
    CHECK(decoder.read() == EdgeDecoder::Room + i);
  }
}

TEST_CASE("a character ends by the clock in its first stop bit, and no earlier") {
  Wave wave;
  wave.character(0xFE);  // 20 us high, and low for the rest
  const std::vector<uint8_t> edges = noted(wave);
  EdgeDecoder decoder;
  decoder.begin(true);
  CHECK_FALSE(decoder.isOpen());
  take(decoder, edges);
  CHECK(decoder.isOpen());
  const uint16_t sinceEdge = static_cast<uint16_t>(210 - 40);  // ticks
  decoder.idle(sinceEdge);
  CHECK(decoder.available() == 0);
  decoder.idle(static_cast<uint16_t>(sinceEdge + 1));
  CHECK(decoder.available() == 1);
  CHECK_FALSE(decoder.isOpen());
}

TEST_CASE("any edges, in any order, with any pauses: no character beyond what they hold, and no write outside") {
  std::mt19937 random{20181};
  for (int round = 0; round < 300; round++) {
    EdgeDecoder decoder;
    decoder.begin(random() % 2 == 0);
    size_t edges = 0, characters = 0;
    for (int piece = 0; piece < 50; piece++) {
      std::vector<uint8_t> part(1 + random() % 255);
      for (uint8_t &edge : part) {
        const auto any = random();
        edge = static_cast<uint8_t>(any % 8 == 0 ? any >> 8 : any % 8 == 1 ? any >> 8 & 3 : 20 * (1 + (any >> 8 & 3)));
      }
      edges += part.size();
      take(decoder, part);
      if (random() % 2 == 0 && decoder.isOpen()) {
        decoder.idle(static_cast<uint16_t>(random()));
      }
      CHECK(decoder.available() <= unsigned{EdgeDecoder::Room});
      while (random() % 4 != 0 && decoder.available() != 0) {
        decoder.read();
        characters++;
      }
    }
    CHECK(characters <= edges);
  }
}
