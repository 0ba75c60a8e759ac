// Runs the examples that convert S.Bus to other signals and back, on a simulated Mega (PpmOut also on a Leonardo and an
// Uno), and measures how far off the edges are.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "AvrBoard.h"
#include "Expected.h"
#include "line/Source.h"
#include "sbus/Scaling.h"

using namespace avr;

namespace {

constexpr size_t PpmPin = AvrBoard::OC1A;
constexpr double LeastSync = 4500;  // us
// libsimavr moves an edge to the end of the instruction that it falls into, of up to 5 cycles.
constexpr double Instruction = 0.32;  // us

avr::Line flight(uint64_t cutUs = UINT64_MAX) {
  avr::Line line;
  line.source = line::Source().open();
  line.cutUs = cutUs;
  return line;
}

Numbers ppm(const avr::SeenFrame &frame) {
  Numbers channels;
  for (size_t i = 0; i < 8 && !frame.failsafe && !frame.stale; i++) {
    channels.push_back(sbus::toMicroseconds(frame.channels[i], sbus::FrSky));
  }
  return channels;
}

// An old receiver at PwmIn's pins: four pulses every 20 ms, of random widths, one after the other or all at once.
struct OldReceiver {
  struct Sent {
    double us;  // it ends
    double width;
  };
  std::mt19937 random{4711};
  std::vector<avr::Level> levels;
  std::vector<Sent> pulses[4];

  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }

  // Adds a pulse, from `us` on.
  void pulse(size_t channel, double us, double width) {
    levels.push_back({us, channel, true});
    levels.push_back({us + width, channel, false});
    pulses[channel].push_back({us + width, width});
  }
  void fly(double fromUs, double toUs, bool atOnce, size_t without = SIZE_MAX) {
    for (double us = fromUs; us < toUs; us += 20000 + between(-20, 20)) {
      for (size_t channel = 0; channel < 4; channel++) {
        if (channel != without) {
          pulse(channel, us + (atOnce ? 0 : 2500 * static_cast<double>(channel)), between(988, 2012));
        }
      }
    }
  }
  // This many of 100 pulses have a spike in them, or near them.
  void disturb(double percent) {
    const size_t count = levels.size();
    for (size_t i = 0; i < count; i += 2) {
      if (between(0, 100) < percent) {
        const double us = levels[i].us + between(-1500, 3000), width = between(0.5, 60);
        const bool isHigh = us > levels[i].us && us < levels[i + 1].us;
        levels.push_back({us, levels[i].pin, !isHigh});
        levels.push_back({us + width, levels[i].pin, us + width > levels[i].us && us + width < levels[i + 1].us});
      }
    }
  }
  avr::Line line() {
    std::stable_sort(levels.begin(), levels.end(),
                     [](const avr::Level &one, const avr::Level &other) { return one.us < other.us; });
    avr::Line line;
    line.levels = levels;
    return line;
  }
};

struct SentFrame {
  double us;  // it begins
  Channels channels;
  bool failsafe, lostFrame;
};

std::vector<SentFrame> framesOf(const AvrBoard &board) {
  std::vector<SentFrame> frames;
  const std::vector<avr::Sent> &sent = board.sent();
  for (size_t first = 0; first + 25 <= sent.size(); first += 25) {
    Frame frame;
    for (size_t i = 0; i < frame.size(); i++) {
      frame[i] = sent[first + i].byte;
    }
    frames.push_back(
        {static_cast<double>(sent[first].us), readBitByBit(frame), (frame[23] & 8) != 0, (frame[23] & 4) != 0});
  }
  return frames;
}

// Returns how far a channel is off the newest pulse, or the newest but a few, about 2 ms after its end.
double offBy(const SentFrame &frame, size_t channel, const OldReceiver &receiver, size_t most = 2) {
  const std::vector<OldReceiver::Sent> &pulses = receiver.pulses[channel];
  const double us = sbus::toMicroseconds(frame.channels[channel], sbus::FrSky);
  double off = 1e9;
  for (size_t i = pulses.size(), tried = 0; i-- > 0 && tried < most;) {
    if (pulses[i].us + 1800 <= frame.us) {
      tried++;
      off = std::abs(us - pulses[i].width) < std::abs(off) ? us - pulses[i].width : off;
    }
  }
  return off;
}

// The largest errors found, in us.
struct Off {
  double pulse = 0, channel = 0, period = 0;
};

}  // namespace

TEST_CASE("PpmOut: each frame has the newest channels, to 0.5 us, every 22.5 ms; in failsafe there is no frame") {
  struct Run {
    avr::Model model;
    std::string name;
    uint64_t cutUs;
    double seconds;
    size_t frames;                // at least
    double silentFrom, silentTo;  // us
  };
  // 9 frames of 9 ms lost, then the failsafe flag at 10 s; or nothing from 2 s on
  for (const Run &run :
       {Run{avr::Mega, "flight", UINT64_MAX, 13, 460, 10.05e6, 12.5e6},
        Run{avr::Mega, "cut", 2000000, 3, 80, 2.13e6, 3e6}, Run{avr::Leonardo, "cut", 2000000, 3, 80, 2.13e6, 3e6},
        Run{avr::Uno, "cut", 2000000, 3, 80, 2.13e6, 3e6}}) {
    CAPTURE(std::string(run.model.name));
    CAPTURE(run.name);
    const AvrBoard board(run.model, "PpmOut", flight(run.cutUs), run.seconds);
    const Expected expected(board.characters());
    const std::vector<Pulse> &pulses = board.pulses(PpmPin);
    std::string wrong;
    Off off;
    size_t frames = 0;
    for (size_t first = 0; first + 9 < pulses.size(); first += 9, frames++) {
      Numbers channels;
      for (size_t i = 0; i < 9; i++) {
        const Pulse &pulse = pulses[first + i];
        off.pulse = std::max(off.pulse, std::abs(pulse.widthUs - 300));
        if (i < 8) {
          const double us = pulses[first + i + 1].exactUs - pulse.exactUs;
          channels.push_back(std::round(us));
          off.channel = std::max(off.channel, std::abs(us - std::round(us)));
        }
      }
      const double beginsUs = pulses[first].exactUs;
      wrong += wrong.empty() ? expected.wrong(static_cast<uint64_t>(beginsUs) - 1000, channels, ppm, 0) : "";
      CHECK((beginsUs < run.silentFrom || beginsUs > run.silentTo));
      const double toNext = pulses[first + 9].exactUs - beginsUs;
      CHECK(pulses[first + 9].exactUs - pulses[first + 8].exactUs >= LeastSync);
      if (toNext < 40000) {
        off.period = std::max(off.period, std::abs(toNext - 22500));
      }
    }
    CHECK(wrong == "");
    CHECK(frames >= run.frames);
    CHECK(off.pulse <= Instruction);
    CHECK(off.channel <= Instruction);
    CHECK(off.period <= Instruction);
    figure("PpmOut (" + std::string(run.model.name) + "), line " + run.name + ": most that an edge is off",
           rounded(std::max({off.pulse, off.channel, off.period}), 2) + " us");
    CHECK(board.mistakes() == "");
  }
}

TEST_CASE("PwmIn: each pulse of an old receiver is sent as S.Bus, as exactly as interrupts allow") {
  for (const bool atOnce : {false, true}) {
    CAPTURE(atOnce);
    OldReceiver receiver;
    receiver.fly(100000, 10000000, atOnce);
    const AvrBoard board(avr::Mega, "PwmIn", receiver.line(), 10);
    const std::vector<SentFrame> frames = framesOf(board);
    CHECK(frames.size() >= 1090);
    std::vector<double> offs;
    double sum = 0;
    for (const SentFrame &frame : frames) {
      CHECK_FALSE(frame.failsafe);
      CHECK_FALSE(frame.lostFrame);
      for (size_t channel = 0; channel < 4; channel++) {
        const double off = offBy(frame, channel, receiver);
        offs.push_back(off);
        sum += off;
      }
    }
    std::sort(offs.begin(), offs.end());
    const auto at = [&](double part) { return offs[static_cast<size_t>(part * static_cast<double>(offs.size() - 1))]; };
    CHECK(std::max(-at(0), at(1)) <= (atOnce ? 60 : 20));
    CHECK(std::max(-at(0.01), at(0.99)) <= (atOnce ? 40 : 12));
    CHECK(std::abs(sum / static_cast<double>(offs.size())) <= 2);
    figure(std::string("PwmIn (mega), ") + (atOnce ? "all channels at once" : "one channel after the other") +
               ": most that 98 % of the pulses are off; all",
           rounded(std::max(-at(0.01), at(0.99)), 0) + " us; " + rounded(std::max(-at(0), at(1)), 0) + " us");
  }
}

TEST_CASE("PwmIn: a channel without pulses has the lost-frame flag after 60 ms, and failsafe after 300 ms") {
  OldReceiver receiver;
  receiver.fly(100000, 2000000, false);
  const double lastUs = receiver.pulses[1].back().us;
  receiver.fly(2000000, 4000000, false, 1);
  const double againUs = 4000000;
  receiver.fly(againUs, 5000000, false);
  const AvrBoard board(avr::Mega, "PwmIn", receiver.line(), 5);
  for (const SentFrame &frame : framesOf(board)) {
    CAPTURE(frame.us);
    const double age = frame.us > againUs + 10000 ? 0 : frame.us - lastUs;
    if (std::abs(age - 60000) > 1000 && (frame.us < againUs || frame.us > againUs + 10000)) {
      CHECK(frame.lostFrame == (age > 60000));
    }
    if (std::abs(age - 300000) > 1000 && (frame.us < againUs || frame.us > againUs + 10000)) {
      CHECK(frame.failsafe == (age > 300000));
      CHECK((frame.channels[2] == 172) == (age > 300000));
    }
  }
}

TEST_CASE("PwmIn: spikes of 0.5 to 60 us in a fifth of the pulses change no channel: the pulse before stays") {
  OldReceiver receiver;
  receiver.fly(100000, 10000000, false);
  receiver.disturb(20);
  const AvrBoard board(avr::Mega, "PwmIn", receiver.line(), 10);
  double most = 0;
  size_t lost = 0;
  const std::vector<SentFrame> frames = framesOf(board);
  for (const SentFrame &frame : frames) {
    lost += frame.lostFrame;
    CHECK_FALSE(frame.failsafe);
    for (size_t channel = 0; channel < 4; channel++) {
      most = std::max(most, std::abs(offBy(frame, channel, receiver, 8)));
    }
  }
  CHECK(frames.size() >= 1090);
  CHECK(most <= 60 + 20);  // a spike at a pulse's edge moves it
  MESSAGE("with spikes: off by ", most, " us at most, ", lost, " of ", frames.size(),
          " frames with the lost-frame flag");
}
