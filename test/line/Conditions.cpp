#include "Conditions.h"

#include <algorithm>
#include <initializer_list>

#include "Runs.h"

namespace {

// A pause is seen as such if it is longer than a loop period and what the driver holds back.
const std::vector<Setup> Seen = {
    {6000, 50},    {7000, 50},       {14000, 50},        {9000, 3000, Board, 256},
    {15000, 3000}, {9000, 50, ByteByByte}, {9000, 1000, Fifo}, {9000, 50, Esp32Told, 256}, {14000, 3000, Esp32Told, 256}};
// Each poll finds a whole frame, so nobody tells a pause from a slow loop.
const std::vector<Setup> WholeFrames = {{9000, 50, Esp32, 256}, {14000, 3000, Esp32, 256}, {9000, 3000, Esp32, 64},
                                        {14000, 5000, Esp32, 256}};
const std::vector<Setup> Hidden = {{4000, 50}, {4000, 3000}, {7000, 3000}};
const std::vector<Setup> InStep = {{4000, 2000}, {4000, 4000}, {6000, 3000}, {6000, 6000}};
const std::vector<Setup> InStepBytes = {{4000, 2000, ByteByByte}, {4000, 4000, ByteByByte}, {6000, 3000, ByteByByte},
                                        {7000, 3500, ByteByByte}, {9000, 3000, ByteByByte}, {9000, 4500, ByteByByte}};
const std::vector<Setup> Buffers = {{9000, 50, ByteByByte, 31},   {9000, 3000, Board, 31}, {9000, 1000, Fifo, 63},
                                    {9000, 3000, ByteByByte, 63}, {9000, 3000, Fifo, 512}};
const std::vector<Setup> JoinSeen = {
    {7000, 50}, {9000, 50}, {9000, 3000}, {15000, 3000}, {9000, 1000, ByteByByte}, {9000, 1000, Esp32Told, 256}};
const std::vector<Setup> Telemetry = {{9000, 50}, {9000, 3000}, {15000, 50}, {15000, 5000}};
const std::vector<Setup> Telemetry15 = {
    {15000, 5000}, {15000, 5000, ByteByByte}, {15000, 5000, Fifo}, {15000, 5000, Esp32, 256}};
const std::vector<Setup> LongTail = {{6000, 50}, {9000, 50}, {9000, 3000}, {15000, 3000, Esp32, 256}};
const std::vector<Setup> Odd2F = {{14000, 50}, {14000, 3000}, {15000, 50}};
const std::vector<Setup> With2F = {
    {15000, 50}, {18000, 50}, {20000, 50}, {18000, 3000}, {18000, 50, ByteByByte}, {18000, 1000, Fifo},
    {18000, 50, Esp32Told, 256}};
const std::vector<Setup> Channels24 = {
    {7000, 50}, {9000, 50}, {9000, 3000}, {14000, 3000, ByteByByte}, {9000, 50, Esp32, 256}};
const std::vector<Setup> Channels24Fast = {{7000, 50},   {7000, 1000},             {7000, 50, ByteByByte},
                                           {9000, 1000}, {9000, 1000, ByteByByte}, {14000, 50, ByteByByte}};
// Of 36 characters; the short pauses are 0.7 ms.
const std::vector<Setup> Seen24 = {
    {7000, 50}, {9000, 50}, {14000, 50}, {11000, 3000, Board, 256}, {15000, 3000}, {9000, 50, ByteByByte},
    {9000, 1000, Fifo}, {9000, 50, Esp32Told, 256}, {15000, 3000, Esp32Told, 256}};
const std::vector<Setup> Hidden24 = {{5000, 50}, {5000, 3000}, {8000, 3000}};
const std::vector<Setup> JoinSeen24 = {{9000, 50}, {11000, 3000}, {15000, 3000}, {9000, 1000, ByteByByte},
                                       {9000, 1000, Esp32Told, 256}};
const std::vector<Setup> Slow24 = {{9000, 5000}, {9000, 5000, ByteByByte}, {9000, 5000, Fifo}, {14000, 5000}};
const std::vector<Setup> Blocked24 = {{7000, 50}, {9000, 50}, {9000, 50, ByteByByte, 63}, {14000, 50, Fifo},
                                      {9000, 50, Esp32Told, 256}};
// Of 25 characters, which a class for 36 reads.
const std::vector<Setup> Other = {{7000, 50}, {7000, 1000}, {9000, 50}, {9000, 1000}, {14000, 50}, {14000, 1000},
                                  {7000, 50, ByteByByte}, {9000, 1000, ByteByByte}, {14000, 1000, ByteByByte}};
const std::vector<Setup> Slow = {{7000, 5000},        {9000, 5000},       {9000, 5000, ByteByByte},
                                 {9000, 5000, Fifo},  {14000, 5000}};
const std::vector<Setup> Slower = {{6000, 20000}, {9000, 20000}, {14000, 20000, Fifo}, {15000, 20000}};
// delay(19): a frame waits for up to two of its periods, or comes just after a call.
const std::vector<Setup> Delay19 = {
    {7000, 19000, Board, 256},      {9000, 19000, Board, 256}, {14000, 19000, ByteByByte, 256},
    {15000, 19000, ByteByByte, 63}, {9000, 19000, Fifo, 256},  {14000, 19000, Esp32Told, 256}};
const std::vector<Setup> SlowerLarge = {
    {4000, 20000, Board, 256}, {9000, 20000, ByteByByte, 512}, {9000, 20000, Esp32, 256}};
const std::vector<Setup> Blocked = {{6000, 50}, {9000, 50}, {9000, 50, ByteByByte, 63}, {14000, 50, Fifo},
                                    {9000, 50, Esp32Told, 256}};
const std::vector<Setup> BlockedLarge = {{9000, 50, Board, 256}, {9000, 50, ByteByByte, 256}, {14000, 50, Fifo, 256}};

// Every driver.
std::vector<Setup> drivers(std::initializer_list<uint32_t> periodsUs, std::initializer_list<uint32_t> loopsUs) {
  std::vector<Setup> setups;
  for (const Driver &driver : {Board, ByteByByte, Fifo, Esp32Told, Esp32}) {
    for (const uint32_t periodUs : periodsUs) {
      for (const uint32_t loopUs : loopsUs) {
        setups.push_back({periodUs, loopUs, driver, driver.isBoards() ? 64u : 256u});
      }
    }
  }
  return setups;
}

// For Fast S.Bus half of these, and what FrSky's ACCESS receivers send, 4 to 9 ms.
const std::vector<Setup> FastSeen = {{3000, 50}, {4500, 1500, Board, 256}, {7500, 50}, {7000, 1500, ByteByByte}};
const std::vector<Setup> FastHidden = {{2000, 50}, {3500, 1500}};
const std::vector<Setup> FastBlocked = {{3000, 50}, {4500, 50, Board, 256}, {9000, 50}};

// Every driver, every period, and these loops.
std::vector<Setup> joins(std::initializer_list<uint32_t> loopsUs) {
  std::vector<Setup> setups;
  for (const Driver &driver : {Board, ByteByByte, Fifo, Esp32}) {
    for (const uint32_t periodUs : {4000u, 5000u, 6000u, 7000u, 9000u, 11000u, 14000u}) {
      for (const uint32_t loopUs : loopsUs) {
        setups.push_back({periodUs, loopUs, driver, 256});
      }
    }
  }
  return setups;
}

// A made-up payload holds whole frames of the other size.
const std::vector<Payload> NotMadeUp = {Payload::Uniform, Payload::Smooth, Payload::Neutral,      Payload::Still,
                                        Payload::Equal,   Payload::Zeros,  Payload::LowChannel16, Payload::Failsafe};

constexpr const char *Splices = "zeros, or chance: halves of two frames look like one, or one like halves";
constexpr const char *Doubtful = "they look like halves of two frames, and are refused until a pause is seen";
constexpr const char *Junk = "altered characters: junk, or flipped bits";
constexpr const char *Glued = "noise straight before a frame hides its pause, and may be a header";
constexpr const char *Between = "after other characters what looks like halves of two frames is refused";
constexpr const char *Inside = "a block within a frame looks like a pause if few of its characters are left";
constexpr const char *Larger = "who found 63 bytes takes the port's buffer for full";
constexpr const char *Gap = "the pause between the two may be 0.6 ms, and is not seen: then they are as one";
constexpr const char *LongLoop = "of a loop period above 8 ms no pause is seen for sure";

constexpr const char *Stops = "after a silence longer than any frame period the first frame may stand anywhere";

constexpr const char *FirstPause = "where pauses are seen now and then, the first frame has to stand at one";

constexpr Limits None = {0, 0};
constexpr Limits Usual = {1e-3, 0};
constexpr Limits Printed = {NotBound, NotBound, "a UART cannot insert a character in a frame"};
constexpr Limits Hidden1 = {0.15, 1 / 500., FirstPause};
constexpr Limits Hidden2 = {NotBound, 1 / 500., Doubtful};
constexpr Limits Rare = {2e-5, 0, Splices};
constexpr Limits Hidden3 = {NotBound, 1e-4, Doubtful};
constexpr Limits NeverWrong = {NotBound, 0, Doubtful};

}  // namespace

const std::vector<Condition> &conditions() {
  static const std::vector<Condition> list = {
      {"clean", plain(), Seen, None, None},
      {"clean, short pauses", plain(), Hidden, None, Hidden3},
      {"clean, by events", plain(), byEvents(Seen), None, None},
      {"clean, the line stops", stopping(), Seen, None, {0.05, 0, Stops}},
      {"clean, other buffers", plain(), Buffers, None, None},
      {"clean, whole frames at once", plain(), WholeFrames, {0.01, 0, Doubtful}, Hidden3},
      {"clean, loop in step", inStep(), InStep, Rare, Hidden3},
      {"clean, loop in step, bytes", inStep(), InStepBytes, Rare, Hidden3},
      {"clean, S.BUS2 with telemetry", slots(1), Telemetry, {1e-4, 0, Between}, {1e-4, 0, Between}},
      {"clean, spread over 4 ms", spread(), drivers({7000, 9000, 11000, 14000, 15000}, {50, 300, 1000, 2000, 3000, 5000}),
       None, NeverWrong, {}, 1000},
      {"clean, R7003SB", of(Kind::R7003SB), LongTail, None, None},
      {"clean, odd 2F frames between", of(Kind::Odd2F), Odd2F, None, None},
      {"clean, 2F frames", of(Kind::With2F), With2F, None, None},
      {"2F frames, dropped 1/300", dropped(1 / 300., Kind::With2F), With2F, {0.005, 5e-5, Gap}, {0.05, 1e-3, Gap}},
      {"2F frames, bursts 1/500", with(&Impairments::burst, 1 / 500., Kind::With2F), With2F, {0.01, 0.004, Gap},
       {0.1, 0.03, Gap}},
      {"dropped 1/500", dropped(1 / 500.), Seen, Usual, Usual},
      {"dropped 1/500, short pauses", dropped(1 / 500.), Hidden, Hidden1, Hidden2},
      {"dropped 1/300", dropped(1 / 300.), Seen, Usual, Usual},
      {"dropped 1/300, by events", dropped(1 / 300.), byEvents(Seen), Usual, Usual},
      {"dropped 1/300, short pauses", dropped(1 / 300.), Hidden, Hidden1, Hidden2},
      {"dropped 1/300, whole frames at once", dropped(1 / 300.), WholeFrames, {0.03, 0, Doubtful}, Hidden2},
      {"dropped 1/50", dropped(1 / 50.), Seen, {1e-3, 5e-5, Splices}, {1e-3, 1e-4, Splices}},
      {"dropped 1/50, short pauses", dropped(1 / 50.), Hidden, {0.15, 1 / 400., FirstPause},
       {NotBound, 1 / 250., Doubtful}},
      {"bursts 1/500", with(&Impairments::burst, 1 / 500.), Seen, Usual, {1e-3, 1e-3, Junk}},
      {"bursts 1/500, short pauses", with(&Impairments::burst, 1 / 500.), Hidden, {0.15, 0.005, Junk},
       {NotBound, 0.03, Junk}},
      {"inserted 1/500", with(&Impairments::inserted, 1 / 500.), Seen, Printed, Printed},
      {"inserted 1/500, short pauses", with(&Impairments::inserted, 1 / 500.), Hidden, Printed, Printed},
      {"two bits flipped 1/300", with(&Impairments::flipped, 1 / 300.), Seen, Usual, {1e-3, 5e-4, Junk}},
      {"two bits flipped 1/300, short pauses", with(&Impairments::flipped, 1 / 300.), Hidden, Hidden1,
       {NotBound, 0.04, Junk}},
      {"noise in 1/10 of the pauses", noise(1 / 10.), Seen, {0.002, 1e-4, Glued}, {0.2, 5e-4, Glued}},
      {"noise in 1/10, short pauses", noise(1 / 10.), Hidden, Hidden1, {NotBound, 0.005, Glued}},
      {"noise in 1/3 of the pauses", noise(1 / 3.), Seen, {0.002, 1e-4, Glued}, {0.2, 5e-4, Glued}},
      {"noise in 1/3, short pauses", noise(1 / 3.), Hidden, Hidden1, {NotBound, 0.005, Glued}},
      {"joined midway", joined(), JoinSeen, None, None},
      {"joined midway, short pauses", joined(), Hidden, {0.005, 0, Splices}, {NotBound, 0.02, Doubtful}},
      {"joined, failsafe frame", joined(), joins({50, 1000, 3000, 5000}), None, NeverWrong, {Payload::Failsafe}},
      {"joined, failsafe frame, slow loops", joined(), joins({10000, 20000}), None, NeverWrong, {Payload::Failsafe}},
      {"S.BUS2, dropped 1/300", slots(1, dropped(1 / 300., Kind::Sbus2)), Telemetry, {0.003, 0, Splices}, {0.003, 1e-3, Splices}},
      {"S.BUS2 at 15 ms, dropped 1/50", slots(1, dropped(1 / 50., Kind::Sbus2)), Telemetry15, Usual, {1e-3, 2e-4, Splices}},
      {"S.BUS2 at 15 ms, dropped 1/50, by events", slots(1, dropped(1 / 50., Kind::Sbus2)), byEvents(Telemetry15),
       {1e-3, 1e-4, Splices}, {1e-3, 2e-4, Splices}},
      {"S.BUS2 at 15 ms, bursts 1/300", slots(1, with(&Impairments::burst, 1 / 300., Kind::Sbus2)), Telemetry15,
       {1e-3, 2e-4, Junk}, {3e-3, 1e-3, Junk}},
      {"R7003SB, dropped 1/300", dropped(1 / 300., Kind::R7003SB), LongTail, Usual, {1e-3, 2e-4, Splices}},
      {"24 channels, clean", long24(plain()), Seen24, None, None},
      {"24 channels, clean, short pauses", long24(plain()), Hidden24, None, Hidden3},
      {"24 channels, dropped 1/300", long24(dropped(1 / 300.)), Seen24, Usual, Usual},
      {"24 channels, dropped 1/300, short pauses", long24(dropped(1 / 300.)), Hidden24, Hidden1,
       {NotBound, 1 / 250., Doubtful}},
      {"24 channels, dropped 1/50", long24(dropped(1 / 50.)), Seen24, {1e-3, 5e-5, Splices}, {1e-3, 1e-4, Splices}},
      {"24 channels, bursts 1/500", long24(with(&Impairments::burst, 1 / 500.)), Seen24, {1e-3, 5e-5, Junk},
       {1e-3, 1e-3, Junk}},
      {"24 channels, two bits flipped 1/300", long24(with(&Impairments::flipped, 1 / 300.)), Seen24, Usual,
       {1e-3, 5e-4, Junk}},
      {"24 channels, noise in 1/10 of the pauses", long24(noise(1 / 10.)), Seen24, {0.002, 1e-4, Glued},
       {0.2, 5e-4, Glued}},
      {"24 channels, joined midway", long24(joined()), JoinSeen24, None, None},
      {"24 channels, loop of 5 ms", long24(plain()), Slow24, {2e-4, 0, Inside}, {0.02, 0, Doubtful}},
      {"24 channels, blocked 2 to 10 ms every 97 ms", long24(blocked(2, 10, 97)), Blocked24, {0.1, 0, Inside},
       {0.2, 0.005, Inside}},
      {"16 channels into 24", by24(plain()), Other, None, None, NotMadeUp},
      {"16 channels into 24, dropped 1/300", by24(dropped(1 / 300.)), Other, None, None, NotMadeUp},
      {"24 channels into 16", of(Kind::Channels24), Channels24, None, None, NotMadeUp},
      {"24 channels into 16, quick loops", of(Kind::Channels24), Channels24Fast, None, None, NotMadeUp},
      {"24 channels into 16, dropped 1/300", dropped(1 / 300., Kind::Channels24), Channels24, None, None, NotMadeUp},
      {"loop of 5 ms", plain(), Slow, {2e-4, 0, Inside}, {0.005, 0, Doubtful}},
      {"loop of 20 ms", plain(), Slower, {0.2, 1e-4, LongLoop}, {NotBound, 1 / 500., LongLoop}},
      {"loop of 20 ms, large buffers", plain(), SlowerLarge, {0.1, 1e-4, Larger}, {NotBound, 1e-4, LongLoop}},
      {"loop of exactly 19 ms", inStep(), Delay19, {0.1, 1e-4, LongLoop}, {NotBound, 1 / 500., LongLoop}},
      {"loop of exactly 19 ms, by events", inStep(), byEvents(Delay19), {0.1, 1e-4, LongLoop},
       {NotBound, 1 / 500., LongLoop}},
      {"blocked 2 to 10 ms every 97 ms", blocked(2, 10, 97), Blocked, {0.1, 0, Inside}, {0.2, 0.005, Inside}},
      {"blocked 2 to 10 ms every 97 ms, by events", blocked(2, 10, 97), byEvents(Blocked), {0.25, 0, Inside},
       {0.2, 0.005, Inside}},
      {"blocked 2 to 10 ms, large buffers", blocked(2, 10, 97), BlockedLarge, {0.1, 0, Inside}, {0.2, 0.005, Inside}},
      {"blocked 10 to 60 ms every 500 ms", blocked(10, 60, 500), Blocked, {0.03, 0, Inside}, {0.1, 1e-3, Inside}},
      {"blocked 10 to 60 ms, large buffers", blocked(10, 60, 500), BlockedLarge, {0.25, 0, Larger},
       {0.4, 0.003, Larger}},
      {"blocked 200 ms every 500 ms", blocked(200, 200, 500), Blocked, {0.005, 0, Inside}, {0.02, 0, Inside}},
      {"blocked 200 ms, large buffers", blocked(200, 200, 500), BlockedLarge, {0.01, 0, Larger}, {0.06, 0, Larger}},
      {"Fast S.Bus, clean", fast(plain()), FastSeen, None, None},
      {"Fast S.Bus, clean, short pauses", fast(plain()), FastHidden, None, NeverWrong},
      {"Fast S.Bus, dropped 1/300", fast(dropped(1 / 300.)), FastSeen, Usual, Usual},
      {"Fast S.Bus, bursts 1/500", fast(with(&Impairments::burst, 1 / 500.)), FastSeen, Usual, {1e-3, 1e-3, Junk}},
      {"Fast S.Bus, noise in 1/10 of the pauses", fast(noise(1 / 10.)), FastSeen, {0.002, 1e-4, Glued},
       {0.2, 5e-4, Glued}},
      {"Fast S.Bus, joined midway", fast(joined()), FastSeen, None, Usual},
      {"Fast S.Bus, blocked 2 to 10 ms every 97 ms", fast(blocked(2, 10, 97)), FastBlocked, {0.03, 0, Inside},
       {0.1, 0.005, Inside}},
      {"Fast S.Bus, blocked 10 to 60 ms every 500 ms", fast(blocked(10, 60, 500)), FastBlocked, {0.03, 0, Inside},
       {0.1, 1e-3, Inside}},
  };
  return list;
}

std::vector<Payload> Condition::sticks() const {
  std::vector<Payload> all = only;
  if (all.empty()) {
    all = ordinarySticks();
    all.insert(all.end(), deceptiveSticks().begin(), deceptiveSticks().end());
  }
  return all;
}

Tally torture(const Condition &condition, const Setup &setup, Payload sticks, Decoder decoder, uint64_t frames, uint64_t seed) {
  frames = std::min(frames, condition.most);
  Run run = condition.run;
  run.setup = setup;
  run.line.periodUs = setup.periodUs;
  run.line.sticks = sticks;
  run.line.frames = frames;
  if (run.joining) {
    run.line.frames = 12 + 120000 / setup.periodUs;  // a slow loop learns the line for 120 ms
  } else if (run.inStep) {
    run.line.frames = std::min<uint64_t>(frames, 2000);
  }
  Random seeds(ownSeed(condition.name, setup, sticks, seed));
  const uint32_t characterUs = run.line.characterUs();
  Tally sum;
  uint32_t character = 0;
  for (uint64_t done = 0; done < frames; done += run.line.frames) {
    // Joined at every character of a frame, and anywhere within it, over and over.
    run.joinUs = character * characterUs + seeds.below(characterUs);
    character = (character + 1) % (run.reads24 ? sbus::FrameSize24 : sbus::FrameSize);
    sum += simulate(run, decoder, seeds.next());  // in step, each begins at another place of a frame
  }
  return sum;
}
