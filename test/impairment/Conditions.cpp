#include "Conditions.h"

#include <algorithm>
#include <initializer_list>

#include "Runs.h"

namespace {

// A gap is seen if it is longer than a loop period and what the driver holds back.
const std::vector<Setup> Seen = {
    {6000, 50},    {7000, 50},             {14000, 50},        {9000, 3000, Board, 256},
    {15000, 3000}, {9000, 50, ByteByByte}, {9000, 1000, Fifo}, {9000, 50, Esp32Told, 256},
    {14000, 3000, Esp32Told, 256}};
// Each call that finds bytes finds a whole frame.
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
// No gap is seen.
const std::vector<Setup> Channels24Hidden = {{7000, 5000}, {7000, 2000, ByteByByte}, {9000, 5000, ByteByByte}};
const std::vector<Setup> Channels24Fast = {{7000, 50},   {7000, 1000},             {7000, 50, ByteByByte},
                                           {9000, 1000}, {9000, 1000, ByteByByte}, {14000, 50, ByteByByte}};
// Of 36 characters; the short gaps are 0.7 ms.
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
// With delay(19) a frame waits for up to two of its periods, or comes just after a call.
const std::vector<Setup> Delay19 = {
    {7000, 19000, Board, 256},      {9000, 19000, Board, 256}, {14000, 19000, ByteByByte, 256},
    {15000, 19000, ByteByByte, 63}, {9000, 19000, Fifo, 256},  {14000, 19000, Esp32Told, 256}};
const std::vector<Setup> SlowerLarge = {
    {4000, 20000, Board, 256}, {9000, 20000, ByteByByte, 512}, {9000, 20000, Esp32, 256}};
const std::vector<Setup> Blocked = {{6000, 50}, {9000, 50}, {9000, 50, ByteByByte, 63}, {14000, 50, Fifo},
                                    {9000, 50, Esp32Told, 256}};
const std::vector<Setup> BlockedLarge = {{9000, 50, Board, 256}, {9000, 50, ByteByByte, 256}, {14000, 50, Fifo, 256}};

// For Fast S.Bus, half of these periods, and those of FrSky's ACCESS receivers, 4 to 9 ms.
const std::vector<Setup> FastSeen = {{3000, 50}, {4500, 1500, Board, 256}, {7500, 50}, {7000, 1500, ByteByByte}};
const std::vector<Setup> FastHidden = {{2000, 50}, {3500, 1500}};
const std::vector<Setup> FastBlocked = {{3000, 50}, {4500, 50, Board, 256}, {9000, 50}};

// Every period with each of these loops.
std::vector<Setup> joins(std::initializer_list<uint32_t> loopsUs) {
  return everyDriver({4000, 5000, 6000, 7000, 9000, 11000, 14000}, loopsUs);
}

// A made-up payload holds whole frames of the other size.
const std::vector<Payload> NotMadeUp = {Payload::Uniform, Payload::Smooth, Payload::Neutral,      Payload::Still,
                                        Payload::Equal,   Payload::Zeros,  Payload::LowChannel16, Payload::Failsafe};

constexpr const char *Splices = "zeros, or chance: parts of two frames look like one, or one like such parts";
constexpr const char *Doubtful = "they allow a false sync, and are rejected until a gap is seen";
constexpr const char *FirstGap = "where gaps are seen now and then, the first frame has to stand at one";
constexpr const char *Junk = "altered characters: junk, or flipped bits";
constexpr const char *Glued = "noise directly before a frame hides its gap, and may be a header";
constexpr const char *Gap = "the gap between the two may be 0.6 ms, and is not seen: then they are as one";
constexpr const char *Stops = "after a silence longer than any frame period the first frame may stand anywhere";
constexpr const char *Full = "the port's buffer overflows, or is taken for full: 63 bytes may be all that it holds";
constexpr const char *Untold = "by events, a block within a frame looks like a gap";

constexpr Limits None = {0, 0};
constexpr Limits Ordinary = {1e-4, 0};
constexpr Limits Deceptive = {1e-3, 0};
constexpr Limits Spliced = {1e-4, 1e-4, Splices};
constexpr Limits Printed = {NotBound, NotBound, "a UART cannot insert a character in a frame"};
constexpr Limits NeverWrong = {NotBound, 0, Doubtful};
// Gaps are seen now and then, or never.
constexpr Limits HiddenOrdinary = {0.015, 1 / 500., FirstGap};
constexpr Limits HiddenClean = {NotBound, 1e-5, Doubtful};
constexpr Limits HiddenDeceptive = {NotBound, 0.01, Doubtful};
constexpr Limits NoisyOrdinary = {0.0015, 2e-4, Glued};
constexpr Limits NoisyDeceptive = {0.2, 5e-4, Glued};

}  // namespace

const std::vector<Condition> &conditions() {
  static const std::vector<Condition> list = {
      {"clean", plain(), Seen, None, None},
      {"clean, short gaps", plain(), Hidden, None, HiddenClean},
      {"clean, by events", plain(), byEvents(Seen), None, {1e-5, 0, Doubtful}},
      {"clean, the line stops", stopping(), Seen, {1e-4, 0, Stops}, {0.05, 0, Stops}},
      {"clean, other buffers", plain(), Buffers, None, None},
      {"clean, whole frames at once", plain(), WholeFrames, None, None},
      {"clean, loop in step", inStep(), InStep, None, HiddenClean},
      {"clean, loop in step, bytes", inStep(), InStepBytes, None, HiddenClean},
      {"clean, S.BUS2 with telemetry", slots(1), Telemetry, None, None},
      {"clean, spread over 4 ms", spread(),
       everyDriver({7000, 9000, 11000, 14000, 15000}, {50, 300, 1000, 2000, 3000, 5000}), None, NeverWrong, {}, 1000},
      {"clean, R7003SB", of(Kind::R7003SB), LongTail, None, None},
      {"clean, odd 2F frames between", of(Kind::Odd2F), Odd2F, None, None},
      {"clean, 2F frames", of(Kind::With2F), With2F, None, {5e-5, 0, Gap}},
      {"2F frames, dropped 1/300", dropped(1 / 300., Kind::With2F), With2F, {0.005, 5e-5, Gap}, {0.05, 1e-3, Gap}},
      {"2F frames, bursts 1/500", with(&Impairments::burst, 1 / 500., Kind::With2F), With2F, {0.005, 4e-4, Gap},
       {0.06, 0.012, Gap}},
      {"dropped 1/500", dropped(1 / 500.), Seen, Ordinary, Deceptive},
      {"dropped 1/500, short gaps", dropped(1 / 500.), Hidden, HiddenOrdinary, HiddenDeceptive},
      {"dropped 1/300", dropped(1 / 300.), Seen, Ordinary, Deceptive},
      {"dropped 1/300, by events", dropped(1 / 300.), byEvents(Seen), Ordinary, Deceptive},
      {"dropped 1/300, short gaps", dropped(1 / 300.), Hidden, HiddenOrdinary, HiddenDeceptive},
      {"dropped 1/300, whole frames at once", dropped(1 / 300.), WholeFrames, Ordinary, Deceptive},
      {"dropped 1/50", dropped(1 / 50.), Seen, {1e-4, 5e-5, Splices}, {1e-3, 1e-4, Splices}},
      {"dropped 1/50, short gaps", dropped(1 / 50.), Hidden, {0.015, 1 / 300., FirstGap}, HiddenDeceptive},
      {"bursts 1/500", with(&Impairments::burst, 1 / 500.), Seen, Ordinary, {2e-3, 2e-4, Junk}},
      {"bursts 1/500, short gaps", with(&Impairments::burst, 1 / 500.), Hidden, {0.015, 0.007, Junk},
       {NotBound, 0.03, Junk}},
      {"inserted 1/500", with(&Impairments::inserted, 1 / 500.), Seen, Printed, Printed},
      {"inserted 1/500, short gaps", with(&Impairments::inserted, 1 / 500.), Hidden, Printed, Printed},
      {"two bits flipped 1/300", with(&Impairments::flipped, 1 / 300.), Seen, Ordinary, {1e-3, 2e-4, Junk}},
      {"two bits flipped 1/300, short gaps", with(&Impairments::flipped, 1 / 300.), Hidden, HiddenOrdinary,
       {NotBound, 0.05, Junk}},
      {"noise in 1/10 of the gaps", noise(1 / 10.), Seen, NoisyOrdinary, NoisyDeceptive},
      {"noise in 1/10, short gaps", noise(1 / 10.), Hidden, HiddenOrdinary, HiddenDeceptive},
      {"noise in 1/3 of the gaps", noise(1 / 3.), Seen, NoisyOrdinary, NoisyDeceptive},
      {"noise in 1/3, short gaps", noise(1 / 3.), Hidden, HiddenOrdinary, HiddenDeceptive},
      {"joined midway", joined(), JoinSeen, None, None},
      {"joined midway, short gaps", joined(), Hidden, {0.005, 3e-4, Splices}, {NotBound, 1e-3, Doubtful}},
      {"joined, failsafe frame", joined(), joins({50, 1000, 3000, 5000}), None, NeverWrong, {Payload::Failsafe}, 5000},
      {"joined, failsafe frame, slow loops", joined(), joins({10000, 20000}), None, NeverWrong, {Payload::Failsafe},
       5000},
      {"joined, failsafe frame, by events", joined(), byEvents(joins({50, 1000, 3000, 5000, 20000})), None, NeverWrong,
       {Payload::Failsafe}, 1000},
      {"S.BUS2, dropped 1/300", slots(1, dropped(1 / 300.)), Telemetry, Ordinary, {0.005, 1e-3, Splices}},
      {"S.BUS2 at 15 ms, dropped 1/50", slots(1, dropped(1 / 50.)), Telemetry15, {2e-4, 5e-5, Splices},
       {1e-3, 2e-4, Splices}},
      {"S.BUS2 at 15 ms, dropped 1/50, by events", slots(1, dropped(1 / 50.)), byEvents(Telemetry15),
       {1e-3, 2e-4, Splices}, {2e-3, 5e-4, Splices}},
      {"S.BUS2 at 15 ms, bursts 1/300", slots(1, with(&Impairments::burst, 1 / 300.)), Telemetry15, {2e-4, 2e-4, Junk},
       {0.01, 0.0015, Junk}},
      {"R7003SB, dropped 1/300", dropped(1 / 300., Kind::R7003SB), LongTail, Spliced, {1e-3, 3e-4, Splices}},
      {"24 channels, clean", long24(plain()), Seen24, None, None},
      {"24 channels, clean, short gaps", long24(plain()), Hidden24, None, HiddenClean},
      {"24 channels, dropped 1/300", long24(dropped(1 / 300.)), Seen24, Ordinary, Deceptive},
      {"24 channels, dropped 1/300, short gaps", long24(dropped(1 / 300.)), Hidden24, HiddenOrdinary, HiddenDeceptive},
      {"24 channels, dropped 1/50", long24(dropped(1 / 50.)), Seen24, {1e-4, 5e-5, Splices}, {1e-3, 1e-4, Splices}},
      {"24 channels, bursts 1/500", long24(with(&Impairments::burst, 1 / 500.)), Seen24, {1e-4, 5e-5, Junk},
       {1e-3, 2e-4, Junk}},
      {"24 channels, two bits flipped 1/300", long24(with(&Impairments::flipped, 1 / 300.)), Seen24, Ordinary,
       {1e-3, 2e-4, Junk}},
      {"24 channels, noise in 1/10 of the gaps", long24(noise(1 / 10.)), Seen24, NoisyOrdinary, NoisyDeceptive},
      {"24 channels, joined midway", long24(joined()), JoinSeen24, None, None},
      {"24 channels, loop of 5 ms", long24(plain()), Slow24, None, {0.005, 0, Doubtful}},
      {"24 channels, blocked 2 to 10 ms every 97 ms", long24(blocked(2, 10, 97)), Blocked24, {0.003, 0, Full},
       {0.003, 0, Full}},
      {"16 channels into 24", lines(100, by24(plain())), Other, None, None, NotMadeUp},
      {"16 channels into 24, dropped 1/300", lines(100, by24(dropped(1 / 300.))), Other, None, None, NotMadeUp},
      {"24 channels into 16", lines(100, of(Kind::Channels24)), Channels24, None, None, NotMadeUp},
      {"24 channels into 16, quick loops", lines(100, of(Kind::Channels24)), Channels24Fast, None, None, NotMadeUp},
      {"24 channels into 16, short gaps", lines(100, of(Kind::Channels24)), Channels24Hidden, Printed, Printed, NotMadeUp},
      {"24 channels into 16, dropped 1/300", lines(100, dropped(1 / 300., Kind::Channels24)), Channels24, None, None,
       NotMadeUp},
      {"loop of 5 ms", plain(), Slow, None, {1e-3, 0, Doubtful}},
      {"loop of 20 ms", plain(), Slower, {0.1, 1e-5, Full}, {NotBound, 1e-4, Doubtful}},
      {"loop of 20 ms, large buffers", plain(), SlowerLarge, {0.1, 2e-5, Full}, {NotBound, 1e-4, Doubtful}},
      {"loop of exactly 19 ms", inStep(), Delay19, {0.03, 2e-5, Full}, {NotBound, 2e-5, Doubtful}},
      {"loop of exactly 19 ms, by events", inStep(), byEvents(Delay19), {0.1, 2e-5, Full}, {NotBound, 2e-5, Doubtful}},
      {"blocked 2 to 10 ms every 97 ms", blocked(2, 10, 97), Blocked, None, None},
      {"blocked 2 to 10 ms every 97 ms, by events", blocked(2, 10, 97), byEvents(Blocked), {0.2, 0, Untold},
       {0.25, 0.005, Untold}},
      {"blocked 2 to 10 ms, large buffers", blocked(2, 10, 97), BlockedLarge, None, None},
      {"blocked 10 to 60 ms every 500 ms", blocked(10, 60, 500), Blocked, {0.03, 0, Full}, {0.06, 0, Full}},
      {"blocked 10 to 60 ms, large buffers", blocked(10, 60, 500), BlockedLarge, {0.25, 0, Full}, {0.3, 0, Full}},
      {"blocked 200 ms every 500 ms", blocked(200, 200, 500), Blocked, {1e-3, 0, Full}, {0.006, 0, Full}},
      {"blocked 200 ms, large buffers", blocked(200, 200, 500), BlockedLarge, {1e-3, 0, Full}, {0.01, 0, Full}},
      {"Fast S.Bus, clean", fast(plain()), FastSeen, None, None},
      {"Fast S.Bus, clean, short gaps", fast(plain()), FastHidden, None, None},
      {"Fast S.Bus, dropped 1/300", fast(dropped(1 / 300.)), FastSeen, Ordinary, Deceptive},
      {"Fast S.Bus, bursts 1/500", fast(with(&Impairments::burst, 1 / 500.)), FastSeen, Ordinary, {2e-3, 2e-4, Junk}},
      {"Fast S.Bus, noise in 1/10 of the gaps", fast(noise(1 / 10.)), FastSeen, NoisyOrdinary, NoisyDeceptive},
      {"Fast S.Bus, joined midway", fast(joined()), FastSeen, None, None},
      {"Fast S.Bus, blocked 2 to 10 ms every 97 ms", fast(blocked(2, 10, 97)), FastBlocked, {0.02, 0, Full},
       {0.03, 0, Full}},
      {"Fast S.Bus, blocked 10 to 60 ms every 500 ms", fast(blocked(10, 60, 500)), FastBlocked, {0.03, 0, Full},
       {0.05, 0, Full}},
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

Tally impairment(const Condition &condition, const Setup &setup, Payload sticks, Decoder decoder, uint64_t frames,
              uint64_t seed) {
  frames = std::min(frames, condition.most);
  Run run = condition.run;
  run.setup = setup;
  run.line.periodUs = setup.periodUs;
  run.line.sticks = sticks;
  run.line.frames = std::min(run.line.frames, frames);  // then another line begins
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
