// Runs the examples, as they stand, on a simulated Mega, Leonardo and Uno.
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "AvrBoard.h"
#include "Expected.h"

using namespace avr;

namespace {

constexpr double RowTolerance = 0.0006;  // three decimals are printed
constexpr double PulseTolerance = 1;     // us: half of one is the stand-in's, the rest its interrupt's
constexpr double UnoTolerance = 4;       // of the example's own servos, beside an SBusPin

// Returns all that it prints.
std::string textOf(const AvrBoard &board) {
  std::string text;
  for (const Printed &line : board.printed()) {
    text += line.text + "\n";
  }
  return text;
}

// These return the first mistake, or an empty text.
std::string wrongRow(const Expected &expected, const std::vector<Printed> &rows, const Rule &rule) {
  std::string wrong;
  for (size_t i = 0; i < rows.size() && wrong.empty(); i++) {
    wrong = expected.wrong(rows[i].us, avr::numbersIn(rows[i].text), rule, RowTolerance);
  }
  return wrong;
}

// Each frame begins 9 ms after the one before it.
std::string wrongSent(const Expected &expected, const std::vector<avr::Sent> &sent) {
  std::string wrong;
  Frame frame;
  for (size_t first = 0; first + frame.size() <= sent.size() && wrong.empty(); first += frame.size()) {
    for (size_t i = 0; i < frame.size(); i++) {
      frame[i] = sent[first + i].byte;
    }
    const uint64_t us = sent[first].us;
    const uint64_t inTime = sent[0].us + first / frame.size() * 9000;
    wrong = us + 50 < inTime || us > inTime + 1500 ? std::to_string(us) + " us: at the wrong time"
                                                   : expected.wrong(us, avr::numbersOf(frame), avr::mixerSends, 0);
  }
  return wrong;
}

// One comes every 20 ms. On an Uno each begins when the one before ends, which may have another length each time.
std::string wrongPulse(const Model &model, const Expected &expected, const std::vector<avr::Pulse> &pulses,
                       size_t channel) {
  const bool isUno = model.receiver == avr::None;
  const double tolerance = isUno ? UnoTolerance : PulseTolerance;
  const double late = !isUno ? 1 : UnoTolerance + 1024 * static_cast<double>(channel);
  const Rule rule = [channel](const avr::SeenFrame &frame) { return avr::Numbers{avr::servos(frame)[channel]}; };
  std::string wrong;
  for (size_t i = 0; i < pulses.size() && wrong.empty(); i++) {
    const uint64_t us = pulses[i].us;
    const double off = i == 0 ? 0 : std::abs(pulses[i].exactUs - pulses[i - 1].exactUs - 20000);
    wrong = off > late ? std::to_string(us) + " us: at the wrong time"
                       : expected.wrong(us, {pulses[i].widthUs}, rule, tolerance);
  }
  return wrong;
}

}  // namespace

TEST_CASE("the examples print, send and do at their pins what the line says, and in time") {
  struct Run {
    Model model;
    std::string sketch;
    std::string line;
    double seconds;
    size_t rows;  // at least
    Rule rule;
    size_t sent = 0;
    size_t pulses = 0;
  };
  // The recordings' values are AllChannels' on an AVR; what the others make of them is golden on the PC.
  const Run runs[] = {
      {Mega, "AllChannels", "flight", 4, 19, avr::allChannels},
      {Mega, "AllChannels", "frsky-neutral", 1.2, 1, avr::allChannels},
      {Mega, "AllChannels", "paper", 1.2, 2, avr::allChannels},
      {Mega, "AllChannels", "sbus2", 1.2, 4, avr::allChannels},
      {Mega, "DecodeSBus", "flight", 13, 64, avr::decodeSBus},  // from 9.5 s to 12.5 s the radio is off
      {Mega, "DecodeSBus", "cut", 3, 10, avr::decodeSBus},      // and no row when the line has fallen silent
      {Mega, "Mixer", "flight", 13, 64, avr::mixer, 1430},
      {Mega, "Mixer", "cut", 3, 14, avr::mixer,
       330},  // goes on: after 100 ms both flags are set, the throttle is closed
      {Mega, "Normalized", "flight", 4, 19, avr::normalized},
      {Mega, "Servos", "flight", 13, 64, avr::servos, 0, 649},
      {Mega, "Servos", "cut", 3, 14, avr::servos, 0, 149},   // after 100 ms the throttle is closed, and the others hold
      {Mega, "Servos", "silent", 1, 4, avr::servos, 0, 49},  // the throttle is closed, and the others are centred
      {Leonardo, "AllChannels", "sbus2", 1.2, 4, avr::allChannels},  // rows that are longer than a packet
      {Leonardo, "DecodeSBus", "flight", 4, 19, avr::decodeSBus},
      {Leonardo, "DecodeSBus", "cut", 3, 10, avr::decodeSBus},
      {Leonardo, "Mixer", "flight", 4, 19, avr::mixer, 430},
      {Leonardo, "Normalized", "paper", 1.2, 2, avr::normalized},
      {Leonardo, "Servos", "flight", 4, 19, avr::servos, 0, 199},
      {Leonardo, "Servos", "silent", 1, 4, avr::servos, 0, 49},
      {Uno, "AllChannels", "flight", 4, 19, avr::allChannels},
      {Uno, "AllChannels", "frsky-neutral", 1.2, 1, avr::allChannels},
      {Uno, "AllChannels", "sbus2", 1.2, 4, avr::allChannels},
      {Uno, "DecodeSBus", "flight", 13, 64, avr::decodeSBus},
      {Uno, "DecodeSBus", "cut", 3, 10, avr::decodeSBus},
      {Uno, "Normalized", "flight", 4, 19, avr::normalized},
      {Uno, "Servos", "flight", 13, 64, avr::servos, 0, 649},
      {Uno, "Servos", "cut", 3, 14, avr::servos, 0, 149},
      {Uno, "Servos", "silent", 1, 4, avr::servos, 0, 49},
  };
  for (const Run &run : runs) {
    CAPTURE(std::string(run.model.name));
    CAPTURE(run.sketch);
    CAPTURE(run.line);
    const AvrBoard board(run.model, run.sketch, lineOf(run.line), run.seconds);
    const Expected expected(board.characters());
    const std::vector<Printed> &rows = board.printed();
    CHECK(wrongRow(expected, rows, run.rule) == "");
    CHECK(rows.size() >= run.rows);
    CHECK(rows.empty() == (run.rows == 0));
    CHECK(wrongSent(expected, board.sent()) == "");
    CHECK(board.sent().size() >= run.sent * sbus::FrameSize);
    for (size_t pin = 0; pin < 4; pin++) {
      CAPTURE(pin);
      CHECK(wrongPulse(run.model, expected, board.pulses(pin), pin) == "");
      CHECK(board.pulses(pin).size() >= run.pulses);
    }
    CHECK(board.mistakes() == "");
  }
}

TEST_CASE("Loopback says once a second whether its frames come back") {
  const std::pair<std::string, std::string> runs[] = {
      {"wire", "PASS: 100 frames sent, 100 came back right.\n"},
      {"flight", "FAIL: frames come that were not sent. Is a receiver still connected to RX1?\n"},
      {"silent", "FAIL: not a byte comes back. Is TX1 connected to RX1? Are these the pins?\n"},
  };
  for (const auto &run : runs) {
    CAPTURE(run.first);
    const bool passes = run.first == "wire";
    for (const Model &model : {Mega, Leonardo}) {
      CAPTURE(std::string(model.name));
      const AvrBoard board(model, "Loopback", lineOf(run.first), passes ? 2 : 1);
      CHECK(textOf(board) == (passes ? run.second + run.second : run.second));
      CHECK(board.mistakes() == "");
    }
  }
}

TEST_CASE("Diagnose counts the frames of each trial, and finds failsafe when the radio is off") {
  const AvrBoard board(Mega, "Diagnose", lineOf("flight"), 15);
  const Expected expected(board.characters());
  size_t trials = 0;
  std::string words;
  for (const Printed &line : board.printed()) {
    unsigned long baud = 0, frames = 0;
    if (std::sscanf(line.text.c_str(), "begin(%lu): %lu frames", &baud, &frames) == 2) {
      REQUIRE(trials < board.opened().size());
      CHECK(baud == (trials % 2 == 0 ? 100000 : 200000));
      // Between the last poll and the line are read() and Diagnosis::add(), over 250 us: a frame that ends then may
      // count.
      constexpr uint64_t LastPollUs = 400;
      const uint64_t opened = board.opened()[trials];
      const bool isRight = trials % 2 == 0;
      CHECK(frames >= (isRight ? expected.count(opened, line.us - LastPollUs) : 0));
      CHECK(frames <= (isRight ? expected.count(opened, line.us) : 0));
      trials++;
    } else if (line.text.rfind("dSBus", 0) != 0) {
      words += line.text + "\n";
    }
  }
  CHECK(trials == 15);
  std::string said;
  for (int i = 0; i < 7; i++) {
    said += i < 5 ? "All well.\nNothing to do.\n"
                  : "Failsafe: the receiver works, but has lost the link.\nSwitch the radio on, or bind them.\n";
  }
  CHECK(words == said);
  CHECK(board.mistakes() == "USART1: baud rate\n");  // a port that is set wrongly does not go unnoticed
}

TEST_CASE("Diagnose keeps up with a noisy line, of which it examines each byte that belongs to no frame") {
  const AvrBoard board(Mega, "Diagnose", lineOf("noisy"), 8);
  const std::string text = textOf(board);
  CAPTURE(text);
  CHECK(text.find("Noise") != std::string::npos);
  CHECK(text.find("Polled too seldom") == std::string::npos);
}

TEST_CASE("Calibrate finds the sticks' ends and centres, stores them, and uses them for what it prints") {
  const std::string move = "1. Move all sticks, sliders and switches to all their ends.\n";
  const AvrBoard first(Mega, "Calibrate", lineOf("calibration"), 29);
  std::vector<Printed> rows = first.printed();
  const std::string ok = "  CH1 ok 172..1811,  CH2 ok 172..1811,  CH3 ok 172..1811,  CH4 ok 172..1811\n";
  const std::string text = textOf(first);
  CHECK(text.rfind(move, 0) == 0);
  CHECK(text.find(ok + "2. Centre the sticks, but throttle low, and let go.\n" + ok) != std::string::npos);
  CHECK(text.find(ok + "Hands off.\n" + ok + ok + "3. Push both sticks up and right, and hold them there.\n") !=
        std::string::npos);
  CHECK(text.find(ok + "Stored, and read back.\n") != std::string::npos);
  constexpr size_t Said = 4 + 15 + 5 + 2 + 5 + 1;  // steps, a line for each of their seconds, what was stored
  REQUIRE(rows.size() >= Said + 7);
  rows.erase(rows.begin(), rows.begin() + Said);
  const std::vector<uint8_t> eeprom = first.eeprom();
  sbus::Calibration stored;
  std::memcpy(&stored, eeprom.data(), sizeof stored);
  CHECK(wrongRow(Expected(first.characters()), rows, avr::calibrated(stored)) == "");
  CHECK(first.mistakes() == "");
  CHECK(stored.version == 1);
  for (size_t i = 0; i < 4; i++) {  // as extras/line/simulation/Choreography.cpp has them
    constexpr uint16_t Moves[][4] = {
        {172, 1000, 1811, 8}, {1811, 985, 172, 8}, {172, 992, 1811, 0}, {172, 992, 1811, 8}};
    CAPTURE(i);
    CHECK(std::memcmp(&stored.channels[i], Moves[i], sizeof Moves[i]) == 0);
  }
  CHECK(eeprom.begin() + sizeof stored + std::count(eeprom.begin() + sizeof stored, eeprom.end(), 0xFF) ==
        eeprom.end());

  const AvrBoard again(Mega, "Calibrate", lineOf("paper"), 1, eeprom);  // prints numbers at once
  CHECK(wrongRow(Expected(again.characters()), again.printed(), avr::calibrated(stored)) == "");
  CHECK(again.printed().size() >= 2);
  CHECK(again.eeprom() == eeprom);

  std::vector<uint8_t> changed = eeprom;
  changed[50] = 1;  // of CH7, was 0: begins again
  CHECK(textOf(AvrBoard(Mega, "Calibrate", lineOf("calibration"), 1, changed)).rfind(move, 0) == 0);
}
