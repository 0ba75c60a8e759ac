// What is wrong with a line: the finding for what came with each setting, at each limit, and its text.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "sbus/Diagnosis.h"

namespace {

using sbus::Counters;
using sbus::Diagnosis;
using sbus::Finding;
using sbus::Trial;

// What came with a setting, each number by its name.
struct Came {
  Counters counters = {};
  uint32_t pulseless = 0;
  Finding protocol = Finding::NoSignal;

  static Came frames(uint32_t count) { return Came().with(&Counters::frames, count); }
  static Came bytes(uint32_t count) { return Came().skipped(count); }
  Came lost(uint32_t count) const { return with(&Counters::lostFrames, count); }
  Came failsafe(uint32_t count) const { return with(&Counters::failsafeFrames, count); }
  Came byEnd(uint32_t count) const { return with(&Counters::rejectedByEnd, count); }
  Came byFlags(uint32_t count) const { return with(&Counters::rejectedByFlags, count); }
  Came byExtra(uint32_t count) const { return with(&Counters::rejectedByLength, count); }
  Came skipped(uint32_t count) const { return with(&Counters::discardedBytes, count); }
  Came resyncs(uint32_t count) const { return with(&Counters::resyncs, count); }
  Came overflows(uint32_t count) const { return with(&Counters::overflows, count); }
  Came shortfalls(uint32_t count) const { return with(&Counters::shortfalls, count); }
  Came period(uint32_t ms) const { return with(&Counters::period, 1000 * ms); }
  Came other(uint32_t count) const { return with(&Counters::otherSizeFrames, count); }
  Came of(Finding other) const {
    Came came = *this;
    came.protocol = other;
    return came;
  }
  Came withoutPulses(uint32_t count) const {
    Came came = *this;
    came.pulseless = count;
    return came;
  }
  Came extra(uint32_t count) const { return with(&Counters::extraFrames, count); }

 private:
  Came with(uint32_t Counters::*counter, uint32_t count) const {
    Came came = *this;
    came.counters.*counter = count;
    return came;
  }
};

const Came Nothing = Came::frames(0);
const Came Noise = Came::bytes(428);  // what comes with a wrong setting
const Came Good = Came::frames(55);

// Half a second with the settings in the order in which a sketch tries them. The first is the expected one.
Diagnosis diagnosisOf(const std::vector<Came> &came, uint32_t ms = 500) {
  Trial trials[] = {{100000, true, ms, {}, 0, {}},
                    {200000, true, ms, {}, 0, {}},
                    {100000, false, ms, {}, 0, {}},
                    {200000, false, ms, {}, 0, {}}};
  Diagnosis diagnosis;
  for (size_t i = 0; i < came.size(); i++) {
    trials[i].counters = came[i].counters;
    trials[i].pulseless = came[i].pulseless;
    trials[i].other = came[i].protocol;
    diagnosis.add(trials[i]);
  }
  return diagnosis;
}

}  // namespace

TEST_CASE("a setting is right if a frame comes every 100 ms; the finding is the fault to mend first") {
  const struct {
    const char *what;
    std::vector<Came> came;
    Finding finding;
    unsigned best;
  } rows[] = {
      {"not a byte", {Nothing, Nothing, Nothing, Nothing}, Finding::NoSignal, 0},
      {"a byte in the last setting only", {Nothing, Nothing, Nothing, Came::bytes(1)}, Finding::NoFrames, 0},
      {"an open wire that catches noise", {Came::bytes(7), Noise, Noise, Noise}, Finding::NoFrames, 0},
      {"a frame every 100 ms", {Came::frames(5), Noise, Noise, Noise}, Finding::NoFrames, 0},
      {"one more", {Came::frames(6), Noise, Noise, Noise}, Finding::AllWell, 0},
      {"one of 25 Hz, the slowest", {Came::frames(12), Noise, Noise, Noise}, Finding::AllWell, 0},
      {"a good line", {Good, Noise, Noise, Noise}, Finding::AllWell, 0},
      {"the other polarity", {Noise, Noise, Good, Noise}, Finding::WrongPolarity, 2},
      {"the other polarity, nothing with this", {Nothing, Nothing, Good, Nothing}, Finding::WrongPolarity, 2},
      {"the other baud rate", {Noise, Good, Noise, Noise}, Finding::WrongBaud, 1},
      {"both", {Noise, Noise, Noise, Good}, Finding::WrongPolarityAndBaud, 3},
      {"hardly a frame with the other polarity", {Noise, Noise, Came::frames(5), Noise}, Finding::NoFrames, 2},
      {"hardly a frame with the other baud rate", {Noise, Came::frames(5), Noise, Noise}, Finding::NoFrames, 1},
      {"as many with another", {Good, Noise, Good, Noise}, Finding::AllWell, 0},
      {"more with another", {Good, Noise, Came::frames(56), Noise}, Finding::WrongPolarity, 2},
      {"another later has fewer", {Noise, Came::frames(40), Came::frames(30), Noise}, Finding::WrongBaud, 1},
      {"24 channels", {Came::bytes(1980).other(54), Noise, Noise, Noise}, Finding::Channels24, 0},
      {"24 channels, a frame of them every 100 ms", {Came::bytes(1980).other(5)}, Finding::NoFrames, 0},
      {"one more of them", {Came::bytes(1980).other(6)}, Finding::Channels24, 0},
      {"24 channels, the other polarity", {Noise, Noise, Noise.other(54), Noise}, Finding::Channels24, 2},
      {"24 channels, the other baud rate", {Noise, Noise.other(54), Noise.other(1), Noise}, Finding::Channels24, 1},
      {"24 channels, a frame by chance with another",
       {Noise.other(54), Noise, Came::frames(1), Noise},
       Finding::Channels24,
       0},
      {"24 channels, polled too seldom", {Noise.other(6).overflows(1)}, Finding::PolledTooSeldom, 0},
      {"16 channels, so noisy that three have the size of 24", {Came::bytes(1302).other(3)}, Finding::NoFrames, 0},
      {"16 channels, six such before the first", {Good.other(6), Noise, Noise, Noise}, Finding::AllWell, 0},
      {"16 channels, then nine of 24", {Good.skipped(9 * 36).other(9)}, Finding::Channels24, 0},
      {"or eight", {Good.skipped(8 * 36).other(8)}, Finding::AllWellAndMore, 0},
      {"a hundred times as many of 16 as of 24", {Came::frames(10000).other(108)}, Finding::AllWell, 0},
      {"one more of 24", {Came::frames(10000).other(109)}, Finding::Channels24, 0},
      {"a wrong setting comes before the radio", {Noise, Noise, Good.failsafe(55), Noise}, Finding::WrongPolarity, 2},
      {"and before slow polls", {Noise, Noise, Good.overflows(9), Noise}, Finding::WrongPolarity, 2},
      // The setting is right.
      {"a poll found the buffer full", {Good.overflows(1)}, Finding::PolledTooSeldom, 0},
      {"hardly a frame came between them", {Came::frames(4).skipped(28).overflows(2)}, Finding::PolledTooSeldom, 0},
      {"slow polls also damage frames",
       {Came::frames(14).byEnd(40).skipped(900).resyncs(7).overflows(8).failsafe(14)},
       Finding::PolledTooSeldom,
       0},
      {"bytes were lost while interrupts were off", {Good.shortfalls(1)}, Finding::InterruptsOff, 0},
      {"which looks like noise",
       {Came::frames(50).byEnd(15).skipped(124).resyncs(5).shortfalls(5)},
       Finding::InterruptsOff,
       0},
      {"slow polls come before that", {Good.shortfalls(1).overflows(1)}, Finding::PolledTooSeldom, 0},
      {"one damaged", {Came::frames(54).byEnd(3).skipped(24).resyncs(1)}, Finding::AllWell, 0},
      {"two damaged", {Came::frames(53).byEnd(2).skipped(48).resyncs(2)}, Finding::Noise, 0},
      {"10 beside 990 damaged", {Came::frames(990).byEnd(30).skipped(10 * 24).resyncs(10)}, Finding::AllWell, 0},
      {"11 beside 990 damaged", {Came::frames(990).byEnd(30).skipped(11 * 24).resyncs(11)}, Finding::Noise, 0},
      {"damaged, and failsafe", {Came::frames(50).byEnd(15).skipped(124).resyncs(5).failsafe(50)}, Finding::Noise, 0},
      {"packets of another protocol", {Noise.of(Finding::Crsf), Noise}, Finding::Crsf, 0},
      {"packets of another protocol, with the last setting", {Noise, Noise, Noise.of(Finding::IBus)}, Finding::IBus, 0},
      {"frames of S.Bus come before another protocol", {Good.of(Finding::Sumd)}, Finding::AllWell, 0},
      {"DBUS comes before a wrong idle level",
       {Noise.of(Finding::IdleLevel), Noise.of(Finding::Dbus)},
       Finding::Dbus,
       0},
      {"and before packets of one length",
       {Noise.of(Finding::Dbus), Noise.of(Finding::WrongPackets)},
       Finding::Dbus,
       0},
      {"a wrong idle level", {Noise.of(Finding::IdleLevel), Noise}, Finding::IdleLevel, 0},
      {"which only another setting shows", {Noise, Noise, Noise.of(Finding::IdleLevel)}, Finding::NoFrames, 0},
      {"and packets of one length",
       {Noise.of(Finding::WrongPackets), Noise.of(Finding::IdleLevel)},
       Finding::WrongPackets,
       0},
      {"packets of one length, the other polarity",
       {Noise, Noise, Noise.of(Finding::WrongPackets)},
       Finding::WrongPackets,
       0},
      {"packets of one length, polled too seldom",
       {Noise.of(Finding::WrongPackets).overflows(1)},
       Finding::PolledTooSeldom,
       0},
      {"packets of one length of 24 channels", {Noise.of(Finding::WrongPackets).other(54)}, Finding::Channels24, 0},
      {"before frames came", {Good.of(Finding::WrongPackets)}, Finding::AllWell, 0},
      {"unused flags in each", {Noise.of(Finding::UnusedFlags)}, Finding::UnusedFlags, 0},
      {"unused flags in some",
       {Came::frames(30).byFlags(24).skipped(600).resyncs(3).of(Finding::UnusedFlags)},
       Finding::UnusedFlags,
       0},
      {"to the end", {Came::frames(6).byFlags(49).skipped(49 * 25).of(Finding::UnusedFlags)}, Finding::UnusedFlags, 0},
      {"no bit 7", {Good.of(Finding::SevenBits)}, Finding::SevenBits, 0},
      {"no bit 7, damaged",
       {Came::frames(53).byEnd(2).skipped(48).resyncs(2).of(Finding::SevenBits)},
       Finding::Noise,
       0},
      {"no bit 7 comes before no pulses", {Good.withoutPulses(1).of(Finding::SevenBits)}, Finding::SevenBits, 0},
      {"no bit 7, and no frames: text", {Noise.of(Finding::SevenBits)}, Finding::NoFrames, 0},
      {"27 of 55 lost in turn", {Good.lost(27).of(Finding::LostInTurn)}, Finding::LostInTurn, 0},
      {"40 of 55 lost in turn", {Good.lost(40).of(Finding::LostInTurn)}, Finding::LostInTurn, 0},
      {"5 of 55 lost in turn", {Good.lost(5).of(Finding::LostInTurn)}, Finding::AllWell, 0},
      {"lost in turn, then failsafe", {Good.lost(27).failsafe(1).of(Finding::LostInTurn)}, Finding::Failsafe, 0},
      {"0 on CH1 to CH4", {Good.withoutPulses(55)}, Finding::NoPulses, 0},
      {"0 on CH1 to CH4, for a frame", {Good.withoutPulses(1)}, Finding::NoPulses, 0},
      {"no pulses come before failsafe", {Good.withoutPulses(20).failsafe(20)}, Finding::NoPulses, 0},
      {"a wrong setting comes before no pulses", {Noise, Good.withoutPulses(55)}, Finding::WrongBaud, 1},
      {"failsafe without lost frames", {Good.failsafe(55)}, Finding::Failsafe, 0},
      {"failsafe for a while", {Good.failsafe(1)}, Finding::Failsafe, 0},
      {"28 of 55 lost", {Good.lost(28)}, Finding::NoRadio, 0},
      {"27 of 55 lost", {Good.lost(27)}, Finding::Lossy, 0},
      {"12 of 110 lost", {Came::frames(110).lost(12)}, Finding::Lossy, 0},
      {"11 of 110 lost", {Came::frames(110).lost(11)}, Finding::AllWell, 0},
      {"a period of 50 ms", {Came::frames(10).period(50)}, Finding::LongPeriod, 0},
      {"of 49 ms", {Came::frames(10).period(49)}, Finding::AllWell, 0},
      {"of 100 ms", {Came::frames(5).period(100).skipped(24)}, Finding::LongPeriod, 0},
      {"of 200 ms", {Came::frames(2).period(200), Noise}, Finding::LongPeriod, 0},
      {"of 200 ms, with the other polarity", {Noise, Noise, Came::frames(2).period(200)}, Finding::WrongPolarity, 2},
      {"of 100 ms, for less than half of the time", {Came::frames(2).period(100)}, Finding::NoFrames, 0},
      {"of 100 ms, and as much noise", {Came::frames(5).period(100).skipped(199)}, Finding::NoFrames, 0},
      {"... with the other polarity", {Noise, Noise, Came::frames(5).period(100).skipped(199)}, Finding::NoFrames, 2},
      {"of 80 ms, damaged", {Came::frames(6).period(80).byEnd(2).skipped(48).resyncs(2)}, Finding::Noise, 0},
      {"of 80 ms, in failsafe", {Came::frames(6).period(80).failsafe(6)}, Finding::Failsafe, 0},
      {"of a line interrupted for seconds", {Came::frames(3).period(9), Noise}, Finding::NoFrames, 0},
      {"opened within a frame", {Good.byEnd(4).skipped(24)}, Finding::AllWell, 0},
      {"S.BUS2, eight sensors", {Came::frames(33).skipped(216).resyncs(8)}, Finding::AllWellAndMore, 0},
      {"an R7003SB", {Came::frames(33).skipped(165)}, Finding::AllWellAndMore, 0},
      {"FASSTest 26", {Came::frames(28).extra(27).skipped(25)}, Finding::AllWell, 0},
      {"FASSTest 26, eight sensors", {Came::frames(28).extra(27).skipped(190).resyncs(7)}, Finding::AllWellAndMore, 0},
      {"FASSTest 26, some noise", {Came::frames(27).extra(18).skipped(226).resyncs(8)}, Finding::Noise, 0},
      {"exactly that number of bytes", {Came::frames(33).skipped(58)}, Finding::AllWellAndMore, 0},
      {"one less", {Came::frames(33).skipped(57)}, Finding::AllWell, 0},
      {"S.BUS2, all slots and breaks after each frame",
       {Came::frames(33).skipped(33 * 33 + 25)},
       Finding::AllWellAndMore,
       0},
      {"as many bytes as then", {Came::frames(33).skipped(34 * 33)}, Finding::AllWellAndMore, 0},
      {"one more", {Came::frames(33).skipped(34 * 33 + 1).failsafe(33)}, Finding::NoFrames, 0},
      {"bytes of one impaired frame", {Came::frames(54).byEnd(1).skipped(24 + 60).resyncs(1)}, Finding::AllWell, 0},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    const Diagnosis diagnosis = diagnosisOf(row.came);
    CHECK(std::string(text(diagnosis.finding())) == text(row.finding));
    CHECK(diagnosis.best() == row.best);
    CHECK(std::memcmp(&diagnosis.seen(), &row.came[row.best].counters, sizeof(Counters)) == 0);
  }
}

TEST_CASE("begin() forgets the round before") {
  Diagnosis diagnosis = diagnosisOf({Noise, Noise, Good, Noise});
  REQUIRE(diagnosis.finding() == Finding::WrongPolarity);
  diagnosis.begin();
  CHECK(diagnosis.finding() == Finding::NoSignal);
  CHECK(diagnosis.best() == 0);
  CHECK(diagnosis.seen().frames == 0);
  diagnosis.add({100000, false, 500, Good.counters, 0, {}});
  CHECK(diagnosis.finding() == Finding::AllWell);
  diagnosis.begin();
  diagnosis.add({100000, false, 500, Nothing.counters, 0, {}});
  CHECK(diagnosis.finding() == Finding::NoSignal);
}

// Measured on the simulated line, half a second or five, where it is known which frames were sent and did not come.
TEST_CASE("impaired frames are counted, not their headers: with some noise, with much noise, on lines without faults") {
  const struct {
    doctest::String what;
    Came came;
    uint32_t damaged;
  } rows[] = {
      {"nothing", Nothing, 0},
      {"a good line", Good, 0},
      {"30 disturbances a second, 5 are missing", Came::frames(50).byEnd(15).skipped(124).resyncs(5), 5},
      {"300 a second, 45 are missing", Came::frames(10).byEnd(123).skipped(1089).resyncs(8), 45},
      {"1 byte in 300 missing, 3 frames", Came::frames(52).byEnd(9).skipped(72).resyncs(2), 3},
      {"rejected for all three reasons", Came::frames(50).byEnd(1).byFlags(1).byExtra(1).skipped(500).resyncs(9), 3},
      {"the rest of a frame", Good.byEnd(2).skipped(20), 0},
      {"before the first frame it is unknown", Came::bytes(1977).byEnd(219), 0},
      {"FASSTest 26", Came::frames(28).extra(27).skipped(25), 0},
      {"FASSTest 26, 30 a second, 8 of those with header 2F are missing",
       Came::frames(27).extra(18).skipped(226).resyncs(8), 8},
      {"FASSTest 26, 5 and 4", Came::frames(24).extra(19).byEnd(4).skipped(322).resyncs(7), 8},
      {"FASSTest 26, one missing", Came::frames(28).extra(26).skipped(49).resyncs(1), 1},
      {"one more than half of them", Came::frames(28).extra(15).skipped(300).resyncs(9), 12},
      {"half of them: as if there were none", Came::frames(28).extra(14).skipped(300).resyncs(9), 0},
      {"every second frame has lost a byte", Came::frames(28).byEnd(27).skipped(27 * 24).resyncs(27), 27},
      {"as many gaps, but far more skipped", Came::frames(6).byEnd(100).skipped(1000).resyncs(5), 42},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    CHECK(impairedFrames(row.came.counters) == row.damaged);
  }
}

TEST_CASE("each finding has its own text, and a remedy; both are ASCII and fit a line") {
  std::vector<std::string> texts;
  for (unsigned number = 0; number <= static_cast<unsigned>(Finding::AllWell); number++) {
    const auto finding = static_cast<Finding>(number);
    CHECK(std::count(texts.begin(), texts.end(), text(finding)) == 0);
    texts.push_back(text(finding));
    for (const std::string words : {text(finding), remedy(finding)}) {
      CAPTURE(words);
      CHECK(words.size() >= 9);
      CHECK(words.size() <= 100);
      CHECK(std::all_of(words.begin(), words.end(), [](char letter) { return letter >= ' ' && letter <= '~'; }));
    }
  }
}
