// Which frames count as a jump of a channel: a wrong value in a frame, and never a stick, however it is moved.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "line/Condition.h"
#include "line/Jumps.h"
#include "line/Observer.h"
#include "line/report/ObservedFlight.h"
#include "sbus/Frame.h"

namespace {

constexpr double Pi = 3.14159265358979;

// Returns how many jumps a stick makes whose place at a time, in ms, is -1 to 1.
unsigned jumpsOf(const std::function<double(double)> &place, double periodMs, double phaseMs, double packetMs) {
  line::Jumps jumps;
  unsigned count = 0;
  for (unsigned i = 0; i * periodMs < 2000; i++) {
    double ms = phaseMs + i * periodMs;
    ms = packetMs > 0 ? std::floor(ms / packetMs) * packetMs : ms;
    const auto raw = static_cast<uint16_t>(992 + std::lround(819 * place(ms)));
    count += jumps.put(static_cast<uint64_t>(i * periodMs * 1000), &raw, 1, true) != 0;
  }
  return count;
}

// Out and back in `ms`, as smoothly as a hand moves.
double flick(double ms, double length, double height) {
  if (ms < 0 || ms > length) {
    return 0;
  }
  const double t = ms < length / 2 ? 2 * ms / length : 2 - 2 * ms / length;
  return height * t * t * t * (10 - 15 * t + 6 * t * t);
}

// A stick that is let go at its end: its spring swings it to and fro.
double sprung(double ms, double hz) {
  return ms < 100 ? 1 : std::exp(-(ms - 100) * hz / 200) * std::cos(2 * Pi * hz * (ms - 100) / 1000);
}

}  // namespace

TEST_CASE("a channel jumps if it leaves its course for a frame") {
  const struct {
    const char *what;
    std::vector<uint16_t> values;  // 9 ms apart
    int jump;                      // the number of the value; -1: none
  } rows[] = {
      {"the highest value for a frame", {1024, 1030, 2047, 1040, 1045}, 2},
      {"the lowest value", {1024, 1030, 0, 1040, 1045}, 2},
      {"just as far as counts", {1000, 1243, 1000}, 1},
      {"not as far", {1000, 1242, 1000}, -1},
      {"to the other side", {1000, 757, 1000}, 1},
      {"the one after is apart by half", {1000, 1600, 1200, 1200}, 1},
      {"by more", {1000, 1600, 1201, 1201}, -1},
      {"for two frames", {1000, 2047, 2047, 1000}, -1},
      {"to stay", {1000, 1000, 2047, 2047}, -1},
      {"a stick that moves fast", {172, 582, 992, 1402, 1811}, -1},
      {"at the beginning", {2047, 1000, 1000}, -1},
      {"at the end", {1000, 1000, 2047}, -1},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    line::Jumps jumps;
    int jump = -1;
    for (size_t i = 0; i < row.values.size(); i++) {
      const std::array<uint16_t, 16> channels = {992, 992, 172, row.values[i]};
      const uint32_t jumped = jumps.put(9000 * i, channels.data(), channels.size(), true);
      if (jumped != 0) {
        CHECK(jumped == 1 << 3);
        CHECK(jump == -1);
        jump = static_cast<int>(i) - 1;
      }
    }
    CHECK(jump == row.jump);
  }
}

TEST_CASE("no jump: frames too far apart, another number of channels, values of a failsafe") {
  const auto jumped = [](uint64_t us, size_t count, bool areSticks) {
    const std::array<uint16_t, 24> still = {1000}, away = {2000};
    line::Jumps jumps;
    jumps.put(0, still.data(), 16, true);
    jumps.put(us / 2, away.data(), count, areSticks);
    return jumps.put(us, still.data(), 16, true) != 0;
  };
  CHECK(jumped(36500, 16, true));
  CHECK_FALSE(jumped(36600, 16, true));
  CHECK_FALSE(jumped(18000, 24, true));
  CHECK_FALSE(jumped(18000, 16, false));
  CHECK(line::Jumps::least(8000) == 100);
  CHECK(line::Jumps::least(18000) == 243);
  CHECK(line::Jumps::least(40000) == 1200);
}

TEST_CASE("stick flicks are no jumps: frames from 4 to 25 ms apart, radio packets of 0 to 20 ms, at any moment") {
  unsigned lines = 0;
  for (double periodMs : {4.0, 6.0, 7.0, 9.0, 11.0, 14.0, 15.0, 18.0, 20.0, 25.0}) {
    for (double phaseMs = 0; phaseMs < periodMs; phaseMs += 0.5) {
      for (const double packetMs : {0.0, 2.0, 4.0, 10.0, 20.0}) {
        for (double length : {150.0, 170.0, 200.0, 250.0}) {
          CHECK(jumpsOf([&](double ms) { return flick(ms - 100, 0.71 * length, 1); }, periodMs, phaseMs, packetMs) ==
                0);
          CHECK(jumpsOf([&](double ms) { return flick(ms - 100, length, 2) - 1; }, periodMs, phaseMs, packetMs) == 0);
        }
        for (const double hz : {4.0, 5.0, 6.0}) {
          CHECK(jumpsOf([&](double ms) { return sprung(ms, hz); }, periodMs, phaseMs, packetMs) == 0);
        }
        lines++;
      }
    }
  }
  CHECK(lines == 1290);
}

TEST_CASE(
    "an Observer counts jumps, but no failsafe and no lack of pulses; a condition waits for one, and a flight lists "
    "it") {
  line::Observer observer;
  line::ObservedFlight flight(line::CharacterUs);
  const line::Condition condition("jump", {});
  unsigned held = 0;
  for (unsigned i = 0; i < 40; i++) {
    uint16_t channels[sbus::ChannelCount] = {992, 992, 172, 992, 1000, 1000};
    channels[3] = i == 10 || i == 20 || i == 30 ? 2047 : 992;
    channels[5] = i == 20 ? 0 : 1000;
    if (i == 35) {
      std::fill_n(channels, 4, uint16_t{0});
    }
    uint8_t frame[sbus::FrameSize];
    sbus::pack(frame, channels, i == 30, false);
    for (unsigned at = 0; at < sbus::FrameSize; at++) {
      line::Character character;
      character.endUs = 9000 * (i + 1) + 120 * at;
      character.value = frame[at];
      observer.put(character);
      flight.put(character);
    }
    observer.idleUntil(9000 * (i + 1) + 5000);
    held += condition.holds(line::Moment(observer, 9000 * (i + 1) + 5000, false));
    CHECK_FALSE(condition.holds(line::Moment(observer, 9000 * (i + 1) + 5000, true)));
  }
  CHECK(observer.jumps() == 2);
  CHECK(held == 2);
  flight.finish();
  const std::vector<line::FlagSpan> jumps = flight.log().spans(line::FlagSpan::Kind::Jump);
  REQUIRE(jumps.size() == 2);
  CHECK(jumps[0].fromUs == 9000 * 11 + 24 * 120);
  CHECK(jumps[0].us() == 9000);
  CHECK(line::jumpedText(jumps[0]) == "CH4");
  CHECK(line::jumpedText(jumps[1]) == "CH4, CH6");
}

TEST_CASE("a flight with nothing but jumps is a warning, with their number; a channel of 24 has its name") {
  for (const unsigned most : {1U, 2U}) {
    line::ObservedFlight flight(line::CharacterUs);
    for (unsigned i = 0; i < 40; i++) {
      uint16_t channels[sbus::ChannelCount] = {992, 992, 172, 992};
      channels[3] = i == 10 || (i == 20 && most == 2) ? 2047 : 992;
      uint8_t frame[sbus::FrameSize];
      sbus::pack(frame, channels, false, false);
      for (unsigned at = 0; at < sbus::FrameSize; at++) {
        flight.put({9000 * (i + 1) + 120 * at, frame[at]});
      }
    }
    flight.finish();
    const line::FlightVerdict verdict = line::verdictOf(flight.log());
    CHECK(verdict.severity == line::FlightVerdict::Severity::Warning);
    CHECK(verdict.text == "No failsafe, no silence, but channels have jumped for one frame " +
                              std::string(most == 1 ? "1 time" : "2 times") + "; 0.00 % of the frames lost.");
  }
  CHECK(line::jumpedText({line::FlagSpan::Kind::Jump, 0, 9000, 1U << 23}) == "CH24");
}
