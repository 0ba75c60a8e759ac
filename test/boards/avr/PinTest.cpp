// A line straight on a pin of a simulated Uno: how many frames come through, and that none is wrong, whatever the line
// does, and whatever keeps interrupts off. Pin.cpp knows a wrong frame.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "AvrBoard.h"
#include "Expected.h"
#include "line/Line.h"
#include "sbus/FrameFinder.h"

namespace {

using avr::AvrBoard;
using avr::Level;

struct Range {
  double least, most;  // us
};

// What a line and a sketch are like: as a receiver's, 9 ms, without a fault, and a sketch that prints.
struct Row {
  double periodUs = 9000;
  double bitUs = 10;
  double jitterUs = 0;   // each edge is late by up to this
  double spreadUs = 0;   // between two characters
  unsigned pauses = 0;   // of 480 us, in each frame
  double pulses = 0;     // a frame, at any time, in which the line has the other level,
  Range width = {0, 0};  // for so long
  double opens = 0;      // a second; then the line has this level,
  bool isHigh = false;
  Range open = {0, 0};                                         // for so long
  uint16_t shortest = 0, longest = 0, loops = 0, pauseMs = 0;  // of Pin.cpp
  uint16_t apartUs = 0, meddles = 0;                           // likewise
  const char *sketch = "Pin";
};

struct Run {
  const char *name;
  size_t missed;  // frames, at most, of 222 at 9 ms
  void (*set)(Row &row);
};

// The edges of frames whose channel i is the frame's number plus 37 i.
class Wave {
 public:
  Wave(const Row &row, double seconds) : _row(row) {
    for (double us = 50000; us < seconds * 1e6 - 350000; us += row.periodUs) {
      frame(us);
    }
    if (row.pulses > 0) {
      invert(seconds * 1e6);
    }
    if (row.opens > 0) {
      open(seconds * 1e6);
    }
  }

  size_t frames = 0;

  // Returns true if the line is high.
  bool isHigh(double us) const {
    return (std::upper_bound(_edges.begin(), _edges.end(), us) - _edges.begin()) % 2 != 0;
  }

  std::vector<Level> levels() const {
    std::vector<Level> all;
    for (size_t i = 0; i < _edges.size(); i++) {
      all.push_back({_edges[i], avr::SBusInput, i % 2 == 0});
    }
    return all;
  }

 private:
  double between(Range range) { return std::uniform_real_distribution<double>(range.least, range.most)(_random); }

  void edge(double us, bool isHigh) {
    if (isHigh != (_edges.size() % 2 != 0)) {
      _edges.push_back(us + between({0, _row.jitterUs}));
    }
  }

  void frame(double us) {
    uint8_t bytes[25] = {0x0F};
    for (unsigned bit = 0; bit < 176; bit++) {
      const unsigned channel = (static_cast<unsigned>(frames) + 37 * (bit / 11)) & 2047;
      bytes[1 + bit / 8] = static_cast<uint8_t>(bytes[1 + bit / 8] | (channel >> bit % 11 & 1) << bit % 8);
    }
    std::vector<unsigned> pauses(_row.pauses);
    for (unsigned &pause : pauses) {
      pause = 1 + static_cast<unsigned>(_random() % 24);
    }
    for (unsigned i = 0; i < 25; i++) {
      us += 480 * static_cast<double>(std::count(pauses.begin(), pauses.end(), i));
      const unsigned parity = static_cast<unsigned>(__builtin_parity(bytes[i]));
      const unsigned bits = unsigned{bytes[i]} << 1 | parity << 9 | 3u << 10;
      for (unsigned bit = 0; bit < 12; bit++) {
        edge(us + bit * _row.bitUs, (bits >> bit & 1) == 0);
      }
      us += 12 * _row.bitUs + _row.spreadUs;
    }
    frames++;
  }

  void invert(double endUs) {
    for (double us = 50000; us < endUs; us += between({0, 2 * _row.periodUs / _row.pulses})) {
      _edges.push_back(us);
      _edges.push_back(us + between(_row.width));
    }
    std::sort(_edges.begin(), _edges.end());
  }

  void open(double endUs) {
    const std::vector<double> edges = std::move(_edges);
    _edges.clear();
    size_t next = 0;
    const auto closed = [&](double untilUs, bool takes) {
      for (; next < edges.size() && edges[next] < untilUs; next++) {
        if (takes) {
          edge(edges[next], next % 2 == 0);
        }
      }
    };
    _row.jitterUs = 0;
    for (double us = 50000; us < endUs; us += between({0, 2e6 / _row.opens})) {
      closed(us, true);
      edge(us, _row.isHigh);
      us += between(_row.open);
      closed(us, false);
      edge(us, next % 2 != 0);
    }
  }

  Row _row;
  std::mt19937 _random{20181};
  std::vector<double> _edges;  // the first one rises
};

// The sketch disables interrupts for `shortest` to `longest` us in one loop of `loops`.
void mask(Row &row, uint16_t shortest, uint16_t longest, uint16_t loops) {
  row.shortest = shortest;
  row.longest = longest;
  row.loops = loops;
}

// Likewise each `apartUs`, for `us`.
void maskInStep(Row &row, uint16_t us, uint16_t apartUs) {
  mask(row, us, us, 1);
  row.apartUs = apartUs;
}

// What an ideal hardware port makes of a line, behind an inverter: each bit is what two of three samples in its middle
// say, of 16; a wrong parity drops a character, a wrong stop bit does not (core 1.8.6, HardwareSerial_private.h:103).
// Returns how many frames a decoder then finds, and how many of these are wrong.
std::pair<size_t, size_t> idealPort(const Wave &wave, double seconds) {
  constexpr double Sample = 10.0 / 16;
  constexpr uint32_t PollUs = 250;
  sbus::FrameFinderOf<sbus::Frame16> finder;
  finder.reset(0, line::CharacterUs, 0);
  std::pair<size_t, size_t> found{};
  const auto take = [&found](const uint8_t *frame) {
    if (frame != nullptr) {
      uint16_t channels[18];
      sbus::unpack(frame, channels);
      found.first++;
      for (unsigned i = 1; i < 16; i++) {
        if (channels[i] != ((channels[0] + 37 * i) & 2047)) {
          found.second++;
          break;
        }
      }
    }
  };
  const auto bit = [&wave](double startUs, unsigned number) {
    int high = 0;
    for (const unsigned sample : {7, 8, 9}) {
      high += wave.isHigh(startUs + (16 * number + sample) * Sample) ? 1 : 0;
    }
    return high < 2;
  };
  std::deque<uint8_t> waiting;
  uint32_t polledUs = 0;
  double us = 0;
  while (us < seconds * 1e6) {
    if (!wave.isHigh(us) || bit(us, 0)) {
      us += Sample;
    } else {
      unsigned value = 0, ones = 0;
      for (unsigned i = 0; i < 9; i++) {
        value |= (bit(us, 1 + i) ? 1u : 0u) << i;
        ones += bit(us, 1 + i) ? 1 : 0;
      }
      us += (16 * 10 + 10) * Sample;
      if (ones % 2 == 0) {
        waiting.push_back(static_cast<uint8_t>(value));
      }
    }
    for (; polledUs + PollUs < us; polledUs += PollUs) {
      const uint32_t now = polledUs + PollUs;
      if (waiting.empty()) {
        take(finder.idle(now));
        continue;
      }
      finder.poll(static_cast<unsigned>(waiting.size()), now);
      while (!waiting.empty()) {
        *finder.space() = waiting.front();
        waiting.pop_front();
        take(finder.received(1, static_cast<int>(waiting.size())));
      }
    }
  }
  return found;
}

constexpr double Seconds = 2.4;  // frames come until 2.05

std::string resultOf(const avr::Model &model, const Row &row, const Wave &wave, double seconds = Seconds) {
  std::vector<uint8_t> eeprom;
  for (const uint16_t number : {row.shortest, row.longest, row.loops, row.pauseMs, row.apartUs, row.meddles}) {
    eeprom.push_back(static_cast<uint8_t>(number));
    eeprom.push_back(static_cast<uint8_t>(number >> 8));
  }
  avr::Line line;
  line.levels = wave.levels();
  const AvrBoard board(model, row.sketch, std::move(line), seconds, eeprom);
  std::string last;
  for (const avr::Printed &printed : board.printed()) {
    last = avr::numbersIn(printed.text).empty() ? last : printed.text;
  }
  CHECK(board.mistakes() == "");
  return last;
}

}  // namespace

TEST_CASE("a line on a pin: frames come through, and none is wrong, whatever line and sketch do") {
  const Run runs[] = {
      {"7 ms", 3, [](Row &row) { row.periodUs = 7000; }},
      {"9 ms", 2, [](Row &) {}},
      {"14 ms", 2, [](Row &row) { row.periodUs = 14000; }},
      {"97 kbaud", 2, [](Row &row) { row.bitUs = 1000 / 97.0; }},
      {"103 kbaud", 4, [](Row &row) { row.bitUs = 1000 / 103.0; }},
      {"edges late by 0 to 1 us", 5, [](Row &row) { row.jitterUs = 1; }},
      {"edges late by 0 to 3 us", 15, [](Row &row) { row.jitterUs = 3; }},
      {"160 us a character, 14 ms", 2,
       [](Row &row) {
         row.periodUs = 14000;
         row.spreadUs = 40;
       }},
      {"235 us a character, 14 ms", 40,
       [](Row &row) {
         row.periodUs = 14000;
         row.spreadUs = 115;
       }},
      {"two pauses of 480 us, 14 ms", 10,
       [](Row &row) {
         row.periodUs = 14000;
         row.pauses = 2;
       }},
      {"pulses of 0.1 to 3 us, one a frame", 60,
       [](Row &row) {
         row.pulses = 1;
         row.width = {0.1, 3};
       }},
      {"pulses of 3 to 10 us, one in three frames", 60,
       [](Row &row) {
         row.pulses = 0.33;
         row.width = {3, 10};
       }},
      {"open for 1 to 30 ms, ten times a second", 60,
       [](Row &row) {
         row.opens = 10;
         row.open = {1000, 30000};
       }},
      {"high for 0.1 to 0.4 ms, ten times a second", 20,
       [](Row &row) {
         row.opens = 10;
         row.isHigh = true;
         row.open = {100, 400};
       }},
      {"interrupts off for 12 us in each loop", 222, [](Row &row) { mask(row, 12, 12, 1); }},
      {"5 to 30 us, one loop in 8", 100, [](Row &row) { mask(row, 5, 30, 8); }},
      {"20 to 60 us, one in 32", 80, [](Row &row) { mask(row, 20, 60, 32); }},
      {"30 to 40 us, one in 32", 80, [](Row &row) { mask(row, 30, 40, 32); }},
      {"40 to 60 us, one in 16", 130, [](Row &row) { mask(row, 40, 60, 16); }},
      {"20 to 100 us, one in 64", 60, [](Row &row) { mask(row, 20, 100, 64); }},
      {"30 to 200 us, one in 64", 70, [](Row &row) { mask(row, 30, 200, 64); }},
      {"0.3 ms, one in 64", 70, [](Row &row) { mask(row, 300, 300, 64); }},
      {"2 ms, one in 64", 120, [](Row &row) { mask(row, 2000, 2000, 64); }},
      {"5 ms, one in 64", 180, [](Row &row) { mask(row, 5000, 5000, 64); }},
      {"20 us each 9 ms, in step with the line", 80, [](Row &row) { maskInStep(row, 20, 9000); }},
      {"40 us each 9 ms, in step", 190, [](Row &row) { maskInStep(row, 40, 9000); }},
      {"100 us each 9 ms, in step", 223, [](Row &row) { maskInStep(row, 100, 9000); }},
      {"2 ms each 9 ms, in step", 130, [](Row &row) { maskInStep(row, 2000, 9000); }},
      {"30 us each 1800 us, in step with the characters", 190, [](Row &row) { maskInStep(row, 30, 1800); }},
      {"timer 1 set to 0, in one loop in 64", 130,
       [](Row &row) {
         row.loops = 64;
         row.meddles = 1;
       }},
      {"its capture unit set to the other edge, in one loop in 64", 130,
       [](Row &row) {
         row.loops = 64;
         row.meddles = 2;
       }},
      {"delay(1)", 4, [](Row &row) { row.pauseMs = 1; }},
      {"delay(3)", 4, [](Row &row) { row.pauseMs = 3; }},
      {"delay(20)", 222, [](Row &row) { row.pauseMs = 20; }},
      {"delay(20), interrupts off for 0.3 to 0.9 ms", 223,
       [](Row &row) {
         mask(row, 300, 900, 2);
         row.pauseMs = 20;
       }},
      {"delay(20), DecodeSBusBackground", 3,
       [](Row &row) {
         row.pauseMs = 20;
         row.sketch = "PinBackground";
       }},
      {"20 to 100 us, one in 64, DecodeSBusBackground", 70,
       [](Row &row) {
         mask(row, 20, 100, 64);
         row.sketch = "PinBackground";
       }},
  };
  for (const Run &run : runs) {
    CAPTURE(std::string(run.name));
    Row row;
    run.set(row);
    const Wave wave(row, Seconds);
    for (const avr::Model &model : {avr::Uno, avr::atComparator(avr::Mega)}) {
      CAPTURE(std::string(model.name));
      const std::string result = resultOf(model, row, wave);
      const avr::Numbers numbers = avr::numbersIn(result);
      MESSAGE(std::string(run.name), ", ", std::string(model.name), ": ", wave.frames,
              " sent; received, wrong, overflows: ", result);
      REQUIRE(numbers.size() == 3);
      CHECK(numbers[1] == 0);
      CHECK(numbers[0] + static_cast<double>(run.missed) >= static_cast<double>(wave.frames));
      if (row.pauseMs == 20 && std::string(row.sketch) == "Pin") {
        CHECK(numbers[2] > 80);  // more edges than the pin holds, in most loops
      }
    }
  }
}

TEST_CASE("a line on a pin: where pulses make frames wrong, a hardware port gives nearly twice as many") {
  const Wave clean(Row(), Seconds);
  CHECK(idealPort(clean, Seconds) == std::make_pair(clean.frames, size_t{0}));
  const Range widths[] = {{3, 12}, {12, 25}, {25, 60}, {60, 200}};
  for (const Range &width : widths) {
    constexpr double Long = 10;  // seconds
    Row row;
    row.pulses = 1;
    row.width = width;
    const Wave wave(row, Long);
    const std::pair<size_t, size_t> port = idealPort(wave, Long);
    const avr::Numbers pin = avr::numbersIn(resultOf(avr::Uno, row, wave, Long));
    MESSAGE(wave.frames, " frames, pulses of ", width.least, " to ", width.most, " us, one a frame: pin ", pin[0], ", ",
            pin[1], " wrong; ideal port ", port.first, ", ", port.second, " wrong");
    CHECK(pin[1] <= (width.most <= 12 ? 0 : 0.6 * static_cast<double>(port.second)));
  }
}

namespace {

// A frame each 9 ms whose channels are random: 137 edges on average.
class RandomChannels : public line::Line {
 public:
  bool next(uint64_t nowUs, line::Character &character) override {
    character.endUs = 9000 * (_count / 25 + 1) + (_count % 25 + 1) * line::CharacterUs;
    if (character.endUs > nowUs) {
      return false;
    }
    const uint64_t place = _count++ % 25;
    character.value = static_cast<uint8_t>(place == 0 ? 0x0F : place < 23 ? _random() : 0);
    return true;
  }

 private:
  uint64_t _count = 0;
  std::mt19937 _random{20181};
};

}  // namespace

TEST_CASE(
    "a line on a pin takes at most 8 % of the processor's time more than on a hardware port, and stops no clock") {
  const auto loops = [](const avr::Model &model, const char *sketch, uint64_t cutUs) {
    avr::Line line;
    line.source = std::make_unique<RandomChannels>();
    line.cutUs = cutUs;
    const AvrBoard board(model, sketch, std::move(line), 1.7);
    REQUIRE(board.pulses(AvrBoard::Led).size() == 2);
    CHECK(std::abs(board.pulses(AvrBoard::Led)[0].exactUs - 1600000) < 20);
    CHECK(std::abs(board.pulses(AvrBoard::Led)[1].exactUs - 1650500) < 600);  // millis() counts in steps of 1.024 ms
    const std::vector<uint8_t> eeprom = board.eeprom();
    CHECK(eeprom[4] == (cutUs == 0 ? 0 : 111));  // frames, of 9 ms
    return eeprom[0] + 256.0 * eeprom[1];
  };
  const auto share = [&loops](const avr::Model &model, const char *sketch) {
    return 100 * (1 - loops(model, sketch, UINT64_MAX) / loops(model, sketch, 0));
  };
  const double pin = share(avr::Uno, "PinLoops"), port = share(avr::atPort(avr::Uno), "PinLoopsPort");
  avr::figure("a line at an `SBusPin` (uno): part of the board's time", avr::rounded(pin, 0) + " %");
  avr::figure("a line at `Serial`, behind an inverter (uno): part of the board's time", avr::rounded(port, 0) + " %");
  CHECK(pin - port > 2);
  CHECK(pin - port <= 8);
}
