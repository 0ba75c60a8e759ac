// Runs the examples Led and Joystick on simulated boards: what is at a pin, and what a PC gets over USB.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "AvrBoard.h"
#include "Expected.h"
#include "sbus/Scaling.h"

using namespace avr;

TEST_CASE("Led blinks slowly before the first frame, follows CH5 in flight, and blinks fast when the link is lost") {
  struct Blink {
    double fromMs, widthMs;
    size_t count;
    double periodMs;
  };
  struct Run {
    std::string line;
    double seconds;
    std::vector<Blink> blinks;
  };
  const Run runs[] = {
      {"silent", 6.5, {{1000, 1000, 3, 2000}}},
      {"flight",
       14,
       {{2500, 2500, 2, 5000}, {10100, 100, 12, 200}}},  // from 10 s to 12.5 s the receiver is in failsafe
      {"cut", 4.05, {{2100, 100, 10, 200}}},
  };
  for (const Model &model : {Mega, Leonardo, Uno}) {
    for (const Run &run : runs) {
      CAPTURE(std::string(model.name));
      CAPTURE(run.line);
      const AvrBoard board(model, "Led", lineOf(run.line), run.seconds);
      const std::vector<avr::Pulse> &pulses = board.pulses(AvrBoard::Led);
      size_t next = 0;
      for (const Blink &blink : run.blinks) {
        for (size_t i = 0; i < blink.count; i++, next++) {
          REQUIRE(next < pulses.size());
          const double fromMs = blink.fromMs + blink.periodMs * static_cast<double>(i);
          CHECK(pulses[next].exactUs / 1000 == doctest::Approx(fromMs).epsilon(0.005));
          CHECK(pulses[next].widthUs / 1000 == doctest::Approx(blink.widthMs).epsilon(0.02));
        }
      }
      CHECK(pulses.size() == next);
      CHECK(board.mistakes() == "");
    }
  }
}

TEST_CASE("Joystick sends each change of the sticks over a Leonardo's USB") {
  const Rule axes = [](const avr::SeenFrame &frame) {
    const bool isLost = frame.failsafe || frame.stale;
    avr::Numbers numbers{0, 0, -1000, 0, 0, 0, 0, 0, 0};
    unsigned buttons = 0;
    for (size_t i = 0; i < 18 && !isLost; i++) {
      const int part = i < 16 ? sbus::limited(sbus::toNormalized(frame.channels[i], sbus::FrSky), -1000, 1000) : 0;
      if (i < 8) {
        numbers[i] = part;
      } else {
        buttons |= (i < 16 ? part > 500 : frame.channels[i] != 0) ? 1u << (i - 8) : 0;
      }
    }
    numbers[8] = buttons;
    return numbers;
  };
  const AvrBoard board(Leonardo, "Joystick", lineOf("flight"), 13);
  const Expected expected(board.characters());
  std::string wrong;
  for (const avr::Report &report : board.reports()) {
    REQUIRE(report.bytes.size() == 19);
    REQUIRE(report.bytes[0] == 3);
    avr::Numbers numbers;
    for (size_t i = 1; i < 19; i += 2) {
      const int value = report.bytes[i] | report.bytes[i + 1] << 8;
      numbers.push_back(i < 17 ? static_cast<int16_t>(value) : value);
    }
    wrong += wrong.empty() ? expected.wrong(report.us, numbers, axes, 0) : "";
  }
  CHECK(wrong == "");
  CHECK(board.reports().size() >= 1400);
  CHECK(board.mistakes() == "");
}
