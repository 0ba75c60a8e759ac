#include "Conditions.h"

#include <algorithm>
#include <initializer_list>
#include <iterator>

#include "Runs.h"

namespace {

// A gap is seen if it is longer than a loop period and what the driver holds back.
const std::vector<Setup> Seen = {{6000, 50},
                                 {7000, 50},
                                 {14000, 50},
                                 {9000, 3000, Board, 256},
                                 {15000, 3000},
                                 {9000, 50, ByteByByte},
                                 {9000, 1000, Fifo},
                                 {9000, 50, Esp32Told, 256},
                                 {14000, 3000, Esp32Told, 256}};
// Each call that finds bytes finds a whole frame.
const std::vector<Setup> WholeFrames = {
    {9000, 50, Esp32, 256}, {14000, 3000, Esp32, 256}, {9000, 3000, Esp32, 64}, {14000, 5000, Esp32, 256}};
const std::vector<Setup> Hidden = {{4000, 50}, {4000, 3000}, {7000, 3000}};
const std::vector<Setup> InStep = {{4000, 2000}, {4000, 4000}, {6000, 3000}, {6000, 6000}};
const std::vector<Setup> InStepBytes = {{4000, 2000, ByteByByte}, {4000, 4000, ByteByByte}, {6000, 3000, ByteByByte},
                                        {7000, 3500, ByteByByte}, {9000, 3000, ByteByByte}, {9000, 4500, ByteByByte}};
const std::vector<Setup> Buffers = {{9000, 50, ByteByByte, 31},
                                    {9000, 3000, Board, 31},
                                    {9000, 1000, Fifo, 63},
                                    {9000, 3000, ByteByByte, 63},
                                    {9000, 3000, Fifo, 512}};
const std::vector<Setup> JoinSeen = {
    {7000, 50}, {9000, 50}, {9000, 3000}, {15000, 3000}, {9000, 1000, ByteByByte}, {9000, 1000, Esp32Told, 256}};
const std::vector<Setup> Telemetry = {{9000, 50}, {9000, 3000}, {15000, 50}, {15000, 5000}};
const std::vector<Setup> Telemetry15 = {
    {15000, 5000}, {15000, 5000, ByteByByte}, {15000, 5000, Fifo}, {15000, 5000, Esp32, 256}};
const std::vector<Setup> LongTail = {{6000, 50}, {9000, 50}, {9000, 3000}, {15000, 3000, Esp32, 256}};
const std::vector<Setup> Odd2F = {{14000, 50}, {14000, 3000}, {15000, 50}};
const std::vector<Setup> With2F = {{15000, 50},
                                   {18000, 50},
                                   {20000, 50},
                                   {18000, 3000},
                                   {18000, 50, ByteByByte},
                                   {18000, 1000, Fifo},
                                   {18000, 50, Esp32Told, 256}};
const std::vector<Setup> Channels24 = {
    {7000, 50}, {9000, 50}, {9000, 3000}, {14000, 3000, ByteByByte}, {9000, 50, Esp32, 256}};
// No gap is seen.
const std::vector<Setup> Channels24Hidden = {{7000, 5000}, {7000, 2000, ByteByByte}, {9000, 5000, ByteByByte}};
const std::vector<Setup> Channels24Fast = {
    {7000, 50}, {7000, 1000}, {7000, 50, ByteByByte}, {9000, 1000}, {9000, 1000, ByteByByte}, {14000, 50, ByteByByte}};
// Of 36 characters; the short gaps are 0.7 ms.
const std::vector<Setup> Seen24 = {{7000, 50},
                                   {9000, 50},
                                   {14000, 50},
                                   {11000, 3000, Board, 256},
                                   {15000, 3000},
                                   {9000, 50, ByteByByte},
                                   {9000, 1000, Fifo},
                                   {9000, 50, Esp32Told, 256},
                                   {15000, 3000, Esp32Told, 256}};
const std::vector<Setup> Hidden24 = {{5000, 50}, {5000, 3000}, {8000, 3000}};
const std::vector<Setup> JoinSeen24 = {
    {9000, 50}, {11000, 3000}, {15000, 3000}, {9000, 1000, ByteByByte}, {9000, 1000, Esp32Told, 256}};
const std::vector<Setup> Slow24 = {{9000, 5000}, {9000, 5000, ByteByByte}, {9000, 5000, Fifo}, {14000, 5000}};
const std::vector<Setup> Blocked24 = {
    {7000, 50}, {9000, 50}, {9000, 50, ByteByByte, 63}, {14000, 50, Fifo}, {9000, 50, Esp32Told, 256}};
// Of 25 characters, which a class for 36 reads.
const std::vector<Setup> Other = {{7000, 50},
                                  {7000, 1000},
                                  {9000, 50},
                                  {9000, 1000},
                                  {14000, 50},
                                  {14000, 1000},
                                  {7000, 50, ByteByByte},
                                  {9000, 1000, ByteByByte},
                                  {14000, 1000, ByteByByte}};
const std::vector<Setup> Slow = {
    {7000, 5000}, {9000, 5000}, {9000, 5000, ByteByByte}, {9000, 5000, Fifo}, {14000, 5000}};
const std::vector<Setup> Slower = {{6000, 20000}, {9000, 20000}, {14000, 20000, Fifo}, {15000, 20000}};
// With delay(19) a frame waits for up to two of its periods, or comes just after a call.
const std::vector<Setup> Delay19 = {{7000, 19000, Board, 256},       {9000, 19000, Board, 256},
                                    {14000, 19000, ByteByByte, 256}, {15000, 19000, ByteByByte, 63},
                                    {9000, 19000, Fifo, 256},        {14000, 19000, Esp32Told, 256}};
const std::vector<Setup> Blocked = {
    {6000, 50}, {9000, 50}, {9000, 50, ByteByByte, 63}, {14000, 50, Fifo}, {9000, 50, Esp32Told, 256}};
const std::vector<Setup> BlockedLarge = {{9000, 50, Board, 256}, {9000, 50, ByteByByte, 256}, {14000, 50, Fifo, 256}};

// Interrupts are off now and then.
std::vector<Setup> off(const Driver &driver) {
  return {{6000, 50, driver, 256},   {7000, 1000, driver, 256}, {9000, 50, driver, 256},
          {9000, 1000, driver, 256}, {9000, 3000, driver, 256}, {14000, 1000, driver, 256}};
}
std::vector<Setup> offAt9(const Driver &driver) { return {{9000, 50, driver, 256}, {9000, 1000, driver, 256}}; }

// For Fast S.Bus, half of these periods, and those of FrSky's ACCESS receivers, 4 to 9 ms.
const std::vector<Setup> FastSeen = {{3000, 50}, {4500, 1500, Board, 256}, {7500, 50}, {7000, 1500, ByteByByte}};
const std::vector<Setup> FastBlocked = {{3000, 50}, {4500, 50, Board, 256}, {9000, 50}};

// Every period with each of these loops.
std::vector<Setup> joins(std::initializer_list<uint32_t> loopsUs) {
  return everyDriver({4000, 5000, 6000, 7000, 9000, 11000, 14000}, loopsUs);
}

// A made-up payload holds whole frames of the other size.
const std::vector<Payload> NotMadeUp = {Payload::Uniform, Payload::Smooth, Payload::Neutral,      Payload::Still,
                                        Payload::Equal,   Payload::Zeros,  Payload::LowChannel16, Payload::Failsafe};

constexpr Promise None = Promise::None;
constexpr Promise NeverWrong = Promise::NeverWrong;
constexpr Promise Faultless = Promise::Faultless;

std::vector<Payload> chosen(const std::vector<Payload> &from, bool areOrdinary) {
  std::vector<Payload> sticks;
  const std::vector<Payload> &all = ordinarySticks();
  std::copy_if(from.begin(), from.end(), std::back_inserter(sticks),
               [&](Payload which) { return (std::find(all.begin(), all.end(), which) != all.end()) == areOrdinary; });
  return sticks;
}

// PendSV makes the calls of all drivers one after the other, each to its end (GrumpyOldPizza/ArduinoCore-stm32l0
// b1cf1cd, armv6m_pendsv.c:133): the UART's waits for what another one does, such as to write to an SD card.
Run late(uint32_t us, Run run = plain()) {
  run.workUs = us;
  run.workEveryUs = 60000;
  return run;
}

// Libraries that mask interrupts do it for 30 us a LED (Adafruit_NeoPixel), 1 ms a character (SoftwareSerial at 9600
// baud) or 5 ms (a DHT22's). `everyUs`: in step with the line, or not.
Run masked(uint32_t us, uint32_t everyUs, uint32_t unsteadyUs, Run run = plain()) {
  run.maskedUs = us;
  run.maskEveryUs = everyUs;
  run.maskUnsteadyUs = unsteadyUs;
  return run;
}

// Each name has its own, whatever other conditions there are.
uint64_t ownSeed(const std::string &name, uint64_t seed) {
  for (const char c : name) {
    seed = Random(seed + static_cast<unsigned char>(c)).next();
  }
  return seed;
}

// Why frames are missed, or wrong, where nothing is promised:
// - Where no gap is seen, frames that allow a false sync are rejected; any values may allow one by chance.
// - After a silence longer than any frame period the first frame may stand anywhere.
// - Zeros, or chance: the parts of two frames look like one, or one like such parts.
// - Junk and flipped bits look like a header or an end.
// - Noise directly before a frame hides its gap, and may be a header.
// - The gap between a 2F frame and the next may be 0.6 ms, and is not seen.
// - The port's buffer overflows, or is taken for full: 63 bytes may be all that it holds.
// - By events, a block within a frame looks like a gap.
// - With interrupts off a UART loses characters, and an AVR's clock stands still: frames are joined where too little is
//   missing, or too little time has passed, to tell. Ages are too small by the time that the clock has lost.
// - A UART cannot insert a character in a frame: these lines only show what would happen.
const std::vector<Condition> &impairedLines() {
  static const std::vector<Condition> list = {
      {"clean", plain(), Seen, Faultless},
      {"clean, short gaps", plain(), Hidden, NeverWrong},
      {"clean, by events", plain(), byEvents(Seen), NeverWrong},
      {"clean, the line stops", stopping(), Seen, NeverWrong},
      {"clean, other buffers", plain(), Buffers, Faultless},
      {"clean, whole frames at once", plain(), WholeFrames, Faultless},
      {"clean, loop in step", inStep(), InStep, NeverWrong},
      {"clean, loop in step, bytes", inStep(), InStepBytes, NeverWrong},
      {"clean, S.BUS2 with telemetry", slots(1), Telemetry},
      {"clean, spread over 4 ms", spread(),
       everyDriver({7000, 9000, 11000, 14000, 15000}, {50, 300, 1000, 2000, 3000, 5000}), NeverWrong},
      {"clean, R7003SB", of(Kind::R7003SB), LongTail, NeverWrong},
      {"clean, odd 2F frames between", by32(of(Kind::Odd2F)), Odd2F, Faultless},
      {"clean, 2F frames", by32(of(Kind::With2F)), With2F, NeverWrong},
      {"2F frames, dropped 1/300", by32(dropped(1 / 300., Kind::With2F)), With2F},
      {"2F frames, bursts 1/500", by32(with(&Impairments::burst, 1 / 500., Kind::With2F)), With2F},
      {"clean, odd 2F frames between, by DecodeSBus", of(Kind::Odd2F), Odd2F, NeverWrong},
      {"clean, 2F frames, by DecodeSBus", of(Kind::With2F), With2F, NeverWrong},
      {"2F frames, dropped 1/300, by DecodeSBus", dropped(1 / 300., Kind::With2F), With2F},
      {"dropped 1/300", dropped(1 / 300.), Seen},
      {"dropped 1/300, by events", dropped(1 / 300.), byEvents(Seen)},
      {"dropped 1/300, short gaps", dropped(1 / 300.), Hidden},
      {"dropped 1/300, whole frames at once", dropped(1 / 300.), WholeFrames},
      {"dropped 1/50", dropped(1 / 50.), Seen},
      {"dropped 1/50, short gaps", dropped(1 / 50.), Hidden},
      {"bursts 1/500", with(&Impairments::burst, 1 / 500.), Seen},
      {"bursts 1/500, short gaps", with(&Impairments::burst, 1 / 500.), Hidden},
      {"inserted 1/500", with(&Impairments::inserted, 1 / 500.), Seen},
      {"inserted 1/500, short gaps", with(&Impairments::inserted, 1 / 500.), Hidden},
      {"two bits flipped 1/300", with(&Impairments::flipped, 1 / 300.), Seen},
      {"two bits flipped 1/300, short gaps", with(&Impairments::flipped, 1 / 300.), Hidden},
      {"noise in 1/10 of the gaps", noise(1 / 10.), Seen},
      {"noise in 1/10, short gaps", noise(1 / 10.), Hidden},
      {"noise in 1/3, short gaps", noise(1 / 3.), Hidden},
      {"joined midway", joined(), JoinSeen, Faultless},
      {"joined midway, short gaps", joined(), Hidden},
      {"joined, failsafe frame", joined(), joins({50, 1000, 3000, 5000}), NeverWrong, {Payload::Failsafe}},
      {"joined, failsafe frame, slow loops", joined(), joins({10000, 20000}), NeverWrong, {Payload::Failsafe}},
      {"joined, failsafe frame, by events",
       joined(),
       byEvents(joins({50, 1000, 3000, 5000, 20000})),
       NeverWrong,
       {Payload::Failsafe}},
      {"S.BUS2, dropped 1/300", slots(1, dropped(1 / 300.)), Telemetry},
      {"S.BUS2 at 15 ms, dropped 1/50", slots(1, dropped(1 / 50.)), Telemetry15},
      {"S.BUS2 at 15 ms, dropped 1/50, by events", slots(1, dropped(1 / 50.)), byEvents(Telemetry15)},
      {"S.BUS2 at 15 ms, bursts 1/300", slots(1, with(&Impairments::burst, 1 / 300.)), Telemetry15},
      {"R7003SB, dropped 1/300", dropped(1 / 300., Kind::R7003SB), LongTail},
      {"24 channels, clean", long24(plain()), Seen24, Faultless},
      {"24 channels, clean, short gaps", long24(plain()), Hidden24, NeverWrong},
      {"24 channels, dropped 1/300", long24(dropped(1 / 300.)), Seen24},
      {"24 channels, dropped 1/300, short gaps", long24(dropped(1 / 300.)), Hidden24},
      {"24 channels, dropped 1/50", long24(dropped(1 / 50.)), Seen24},
      {"24 channels, two bits flipped 1/300", long24(with(&Impairments::flipped, 1 / 300.)), Seen24},
      {"24 channels, noise in 1/10 of the gaps", long24(noise(1 / 10.)), Seen24},
      {"24 channels, joined midway", long24(joined()), JoinSeen24, Faultless},
      {"24 channels, loop of 5 ms", long24(plain()), Slow24, NeverWrong},
      {"24 channels, blocked 2 to 10 ms every 97 ms", long24(blocked(2, 10, 97)), Blocked24},
      {"16 channels into 24", by24(plain()), Other, None, NotMadeUp},
      {"16 channels into 24, dropped 1/300", by24(dropped(1 / 300.)), Other, None, NotMadeUp},
      {"24 channels into 16", of(Kind::Channels24), Channels24, None, NotMadeUp},
      {"24 channels into 16, quick loops", of(Kind::Channels24), Channels24Fast, None, NotMadeUp},
      {"24 channels into 16, short gaps", of(Kind::Channels24), Channels24Hidden, None, NotMadeUp},
      {"24 channels into 16, dropped 1/300", dropped(1 / 300., Kind::Channels24), Channels24, None, NotMadeUp},
      {"24 channels into 16, eleven lost 1/500", with(&Impairments::eleven, 1 / 500., Kind::Channels24), Channels24,
       None, NotMadeUp},
      {"24 channels into 16, eleven lost 1/500, called back", with(&Impairments::eleven, 1 / 500., Kind::Channels24),
       calledBack({7000, 9000, 14000}, 40), None, NotMadeUp},
      {"24 channels into 16, a slot inside", of(Kind::Channels24), Channels24, None, {Payload::SlotInside}},
      {"loop of 5 ms", plain(), Slow, NeverWrong},
      {"loop of 20 ms", plain(), Slower},
      {"loop of exactly 19 ms", inStep(), Delay19},
      {"loop of exactly 19 ms, by events", inStep(), byEvents(Delay19)},
      {"blocked 2 to 10 ms every 97 ms", blocked(2, 10, 97), Blocked, Faultless},
      {"blocked 2 to 10 ms every 97 ms, by events", blocked(2, 10, 97), byEvents(Blocked)},
      {"blocked 10 to 60 ms every 500 ms", blocked(10, 60, 500), Blocked},
      {"blocked 10 to 60 ms, large buffers", blocked(10, 60, 500), BlockedLarge},
      {"blocked 200 ms every 500 ms", blocked(200, 200, 500), Blocked},
      {"interrupts off for 10 to 150 ms, FIFO 32", interruptsOff(10, 150, 500), off(Pico)},
      {"interrupts off for 5 to 30 ms, FIFO 3", interruptsOff(5, 30, 197), off(Three)},
      {"interrupts off for 9 to 10 ms, FIFO 3", interruptsOff(9, 10, 97), offAt9(Three)},
      {"interrupts off for 5 to 30 ms, AVR", interruptsOff(5, 30, 197), off(Avr)},
      {"interrupts off for 9 to 10 ms, AVR", interruptsOff(9, 10, 97), offAt9(Avr)},
      {"Fast S.Bus, clean", fast(plain()), FastSeen, Faultless},
      {"Fast S.Bus, dropped 1/300", fast(dropped(1 / 300.)), FastSeen},
      {"Fast S.Bus, bursts 1/500", fast(with(&Impairments::burst, 1 / 500.)), FastSeen},
      {"Fast S.Bus, noise in 1/10 of the gaps", fast(noise(1 / 10.)), FastSeen},
      {"Fast S.Bus, joined midway", fast(joined()), FastSeen, Faultless},
      {"Fast S.Bus, blocked 2 to 10 ms every 97 ms", fast(blocked(2, 10, 97)), FastBlocked},
  };
  return list;
}

// With lost characters, the parts of two frames may come in one call, and look like one.
const std::vector<Condition> &lateCallLines() {
  static const std::vector<Setup> setups = calledBack({7000, 9000, 14000}, 40);
  static const std::vector<Condition> lines = {
      {"calls up to 40 us late", plain(), setups, Faultless},
      {"calls up to 1 ms late", late(1000), setups, Faultless},
      {"calls up to 2 ms late", late(2000), setups, NeverWrong},
      {"calls up to 8 ms late", late(8000), setups, NeverWrong},
      {"calls up to 40 us late, dropped 1/300", dropped(1 / 300.), setups, None},
      {"calls up to 1 ms late, dropped 1/300", late(1000, dropped(1 / 300.)), setups, None},
      {"calls up to 2 ms late, dropped 1/300", late(2000, dropped(1 / 300.)), setups, None},
      {"calls up to 8 ms late, dropped 1/300", late(8000, dropped(1 / 300.)), setups, None},
  };
  return lines;
}

const std::vector<Condition> &maskedLines() {
  static const std::vector<Setup> setups = calledBack({7000, 9000, 14000}, 40);
  static const std::vector<Condition> lines = {
      {"masked for 150 us of each ms", masked(150, 1000, 0), setups, NeverWrong},
      {"masked for 400 us of each ms", masked(400, 1000, 0), setups, NeverWrong},
      {"masked for 400 us now and then", masked(400, 1000, 3000), setups, NeverWrong},
      {"masked for 1 ms now and then", masked(1000, 2000, 3000), setups, NeverWrong},
      {"masked for 3 ms now and then", masked(3000, 20000, 9000), setups, NeverWrong},
      {"masked for 400 us now and then, dropped 1/300", masked(400, 1000, 3000, dropped(1 / 300.)), setups},
      {"masked for 1 ms now and then, dropped 1/300", masked(1000, 2000, 3000, dropped(1 / 300.)), setups},
      {"masked for 3 ms now and then, dropped 1/300", masked(3000, 20000, 9000, dropped(1 / 300.)), setups},
      {"masked for 400 us now and then, noise in 1/10 gaps", masked(400, 1000, 3000, noise(1 / 10.)), setups},
      {"masked for 1 ms now and then, noise in 1/10 gaps", masked(1000, 2000, 3000, noise(1 / 10.)), setups},
      {"masked for 400 us now and then, 24 channels into 16, dropped 1/50",
       masked(400, 1000, 3000, dropped(1 / 50., Kind::Channels24)), setups, None, NotMadeUp},
  };
  return lines;
}

}  // namespace

const std::vector<Condition> &conditions() {
  static const std::vector<Condition> list = [] {
    std::vector<Condition> all = impairedLines();
    for (const std::vector<Condition> &more :
         {companyLines(), joinLines(), senderLines(), stretchedLines(), lateCallLines(), maskedLines()}) {
      all.insert(all.end(), more.begin(), more.end());
    }
    return all;
  }();
  return list;
}

std::vector<Payload> Condition::ordinarySticks() const {
  return only.empty() ? ::ordinarySticks() : chosen(only, true);
}

std::vector<Payload> Condition::deceptiveSticks() const {
  return only.empty() ? ::deceptiveSticks() : chosen(only, false);
}

Tally impairment(const Condition &condition, const std::vector<Setup> &setups, const std::vector<Payload> &sticks,
                 Decoder decoder, uint64_t frames, uint64_t seed) {
  Tally sum;
  for (const Payload which : sticks) {
    Random random(ownSeed(condition.name + name(which), seed));
    for (uint64_t done = 0; done < frames;) {
      Run run = condition.run;
      run.setup = setups[random.below(static_cast<uint32_t>(setups.size()))];
      run.line.periodUs = run.setup.periodUs;
      run.line.sticks = which;
      run.joinUs =
          random.below((run.reads == Reads::Channels24 ? sbus::FrameSize24 : sbus::FrameSize) * run.line.characterUs());
      if (condition.vary != nullptr) {
        condition.vary(run, random);
      }
      sum += simulate(run, decoder, random.next());
      done += run.line.frames;
    }
  }
  return sum;
}
