#include "Conditions.h"

namespace {

constexpr uint32_t Short = 50;   // us, a pass of loop()
constexpr uint32_t Long = 3000;  // us, the longest with which issue 3 sets bounds

// A pause is seen as such if it is longer than a pass of loop() and what the driver holds back.
const std::vector<Timing> PausesSeen = {{6000, Short},  {7000, Short}, {9000, Short},  {9000, Long},
                                        {14000, Short}, {14000, Long}, {15000, Short}, {15000, Long}};
const std::vector<Timing> PausesHidden = {{4000, Short}, {4000, Long}, {6000, Long}, {7000, Long}};
const std::vector<Timing> InStep = {{4000, 2000}, {4000, 4000}, {6000, 3000}, {6000, 6000}};
const std::vector<Timing> InStepBytes = {{6000, 3000}, {7000, 3500}, {9000, 3000}, {9000, 4500}};
const std::vector<Timing> InStepBytesShort = {{4000, 2000}, {4000, 4000}};
const std::vector<Timing> JoinSeen = {{7000, Short}, {9000, Short}, {9000, Long}, {15000, Long}};
const std::vector<Timing> JoinHidden = {{4000, Short}, {4000, Long}, {7000, Long}};
const std::vector<Timing> WithTelemetry = {{9000, Short}, {9000, Long}, {15000, Short}, {15000, Long}};
const std::vector<Timing> WithLongTail = {{6000, Short}, {9000, Short}, {9000, Long}, {15000, Long}};
const std::vector<Timing> WithFurther = {{14000, Short}, {14000, Long}, {15000, Short}};
const std::vector<Timing> Blocked = {{6000, Short}, {9000, Short}, {14000, Short}};
const std::vector<Timing> Slow = {{4000, 20000}, {6000, 20000},  {7000, 20000},
                                  {9000, 20000}, {14000, 20000}, {15000, 20000}};

// For Fast S.Bus half of these, and what FrSky's ACCESS receivers send, 4 to 9 ms.
constexpr uint32_t FastLong = 1500;
const std::vector<Timing> FastClean = {{3000, Short}, {3500, Short}, {4500, FastLong}, {7000, FastLong}};
const std::vector<Timing> FastSeen = {{3000, Short}, {4500, FastLong}, {7500, Short}};
const std::vector<Timing> FastHidden = {{2000, Short}, {3500, FastLong}};
const std::vector<Timing> FastJoin = {{3500, Short}, {7500, FastLong}};
const std::vector<Timing> FastBlocked = {{3000, Short}, {9000, Short}};
const std::vector<Timing> FastBlockedHalf = {{3000, Short}, {4500, Short}, {7000, Short}};

// What issue 3 asks for, per damaged frame.
constexpr double Missed = 1e-3;
constexpr double Deceived = 1e-4;  // wrong frames under adversarial sticks
constexpr double Unsafe = 1e-3;    // wrong frames with insertions or 1/50 dropped
constexpr double None = 0;

constexpr const char *Hidden =
    "without visible pauses only the places where looks begin tell a header from a payload like one, after a while";
constexpr const char *SamePlace =
    "where each byte is handed over, looks in step with the frames begin at the same place, be it a header or like one";
constexpr const char *LikeInserted =
    "a noise character that could be an end byte, straight behind a frame, cannot be told from an inserted one";
constexpr const char *LowChannel =
    "with a CH16 below 128 a frame with an inserted character looks whole up to the character behind it";
constexpr const char *FrameLike = "measured; one 36-byte frame of any content in 700 begins like a whole frame";
constexpr const char *Measured = "measured";

Impairments only(double Impairments::*kind, double probability) {
  Impairments impairments;
  impairments.*kind = probability;
  return impairments;
}

struct Limit {
  double missed;
  double wrong;
  const char *reason = "";
};

std::vector<Bound> bounds(const Limit &gentle, const Limit &standing, const Limit &adversarial) {
  return {{gentleSticks(), gentle.missed, gentle.wrong, gentle.reason},
          {standingSticks(), standing.missed, standing.wrong, standing.reason},
          {adversarialSticks(), adversarial.missed, adversarial.wrong, adversarial.reason}};
}

std::vector<Bound> bounds(const Limit &all) {
  return bounds(all, all, all);
}

Condition fast(Condition condition) {
  condition.name = "Fast S.Bus, " + condition.name;
  condition.baud = FastBaud;
  return condition;
}

// Does not change when the list does.
uint64_t ownSeed(const Condition &condition, const Timing &timing, Sticks sticks, uint64_t seed) {
  uint64_t mixed = seed;
  for (const char c : condition.name) {
    mixed = Random(mixed + static_cast<unsigned char>(c)).next();
  }
  for (const uint32_t value : {timing.periodUs, timing.loopUs, static_cast<uint32_t>(sticks)}) {
    mixed = Random(mixed + value).next();
  }
  return mixed;
}

// "9 ms", "3.5 ms"
std::string inMs(uint32_t us) {
  const uint32_t tenths = us % 1000 / 100;
  return std::to_string(us / 1000) + (tenths != 0 ? "." + std::to_string(tenths) : "") + " ms";
}

}  // namespace

const std::vector<Condition> &conditions() {
  static const std::vector<Condition> list = {
      {"clean", {}, Kind::Plain, PausesSeen,
       bounds({None, None})},
      {"clean, short pauses", {}, Kind::Plain, PausesHidden,
       bounds({None, None})},
      {"clean, loop() in step with the frames", {}, Kind::Plain, InStep,
       bounds({None, None}), 0, false, false, true},
      {"clean, in step, a port without DMA", {}, Kind::Plain, InStepBytes,
       bounds({None, None}), 0, false, true, true},
      {"clean, in step, without DMA, short pauses", {}, Kind::Plain, InStepBytesShort,
       bounds({None, None}, {None, None}, {0.05, 0.05, SamePlace}), 0, false, true, true},
      {"dropped 1/500", only(&Impairments::dropped, 1 / 500.), Kind::Plain, PausesSeen,
       bounds({Missed, None}, {Missed, None}, {Missed, Deceived})},
      {"dropped 1/500, short pauses", only(&Impairments::dropped, 1 / 500.), Kind::Plain, PausesHidden,
       bounds({Missed, 1e-4, Hidden}, {Missed, 1e-4, Hidden}, {0.06, 0.04, Hidden})},
      {"dropped 1/300", only(&Impairments::dropped, 1 / 300.), Kind::Plain, PausesSeen,
       bounds({Missed, None}, {Missed, None}, {Missed, Deceived})},
      {"dropped 1/300, short pauses", only(&Impairments::dropped, 1 / 300.), Kind::Plain, PausesHidden,
       bounds({Missed, 1e-4, Hidden}, {Missed, 1e-4, Hidden}, {0.08, 0.05, Hidden})},
      {"dropped 1/50", only(&Impairments::dropped, 1 / 50.), Kind::Plain, PausesSeen,
       bounds({Missed, Unsafe}, {Missed, Unsafe}, {Missed, Unsafe})},
      {"dropped 1/50, short pauses", only(&Impairments::dropped, 1 / 50.), Kind::Plain, PausesHidden,
       bounds({Missed, Unsafe}, {Missed, Unsafe}, {0.16, 0.13, Hidden})},
      {"inserted 1/500", only(&Impairments::inserted, 1 / 500.), Kind::Plain, PausesSeen,
       bounds({Missed, Unsafe}, {Missed, Unsafe}, {Missed, 0.002, LowChannel})},
      {"inserted 1/500, short pauses", only(&Impairments::inserted, 1 / 500.), Kind::Plain, PausesHidden,
       bounds({Missed, Unsafe}, {Missed, Unsafe}, {0.6, 0.45, Hidden})},
      {"two bits flipped 1/300", only(&Impairments::flipped, 1 / 300.), Kind::Plain, PausesSeen,
       bounds({Missed, None}, {Missed, None}, {Missed, 5e-4, Measured})},
      {"two bits flipped 1/300, short pauses", only(&Impairments::flipped, 1 / 300.), Kind::Plain, PausesHidden,
       bounds({0.002, None, Measured}, {0.002, None, Measured}, {0.65, 0.55, Hidden})},
      {"noise in 1/10 of the pauses", only(&Impairments::noise, 0.1), Kind::Plain, PausesSeen,
       bounds({0.005, None, LikeInserted}, {0.003, None, LikeInserted}, {0.005, 2e-4, LikeInserted})},
      {"noise in 1/10, short pauses", only(&Impairments::noise, 0.1), Kind::Plain, PausesHidden,
       bounds({0.025, 1e-4, LikeInserted}, {0.01, 1e-4, LikeInserted}, {0.02, 0.003, Hidden})},
      {"joined midway", {}, Kind::Plain, JoinSeen,
       bounds({None, None}), 0, true},
      {"joined midway, short pauses", {}, Kind::Plain, JoinHidden,
       bounds({None, None}, {None, None}, {1.4, 1.3, Hidden}), 0, true},
      {"S.BUS2 with telemetry", {}, Kind::Sbus2, WithTelemetry,
       bounds({None, None})},
      {"S.BUS2, dropped 1/300", only(&Impairments::dropped, 1 / 300.), Kind::Sbus2, WithTelemetry,
       bounds({Missed, None}, {Missed, None}, {Missed, 0.001, Hidden})},
      {"R7003SB", {}, Kind::R7003SB, WithLongTail,
       bounds({None, None})},
      {"R7003SB, dropped 1/300", only(&Impairments::dropped, 1 / 300.), Kind::R7003SB, WithLongTail,
       bounds({Missed, 1e-4, Hidden}, {Missed, None}, {Missed, Deceived})},
      {"2F and 36-byte frames between", {}, Kind::Further, WithFurther,
       bounds({3e-4, 2e-5, FrameLike}, {3e-4, 2e-5, FrameLike}, {3e-4, 2e-5, FrameLike})},
      {"loop() of 20 ms", {}, Kind::Plain, Slow,
       bounds({0.05, 2e-5, Hidden}, {0.05, 1e-4, Hidden}, {0.25, 0.2, Hidden})},
      {"blocked 12 ms every 500 ms", {}, Kind::Plain, Blocked,
       bounds({5e-4, None}, {5e-4, None}, {5e-4, 5e-5, Hidden}), 12000},
      {"blocked 20 ms every 500 ms", {}, Kind::Plain, Blocked,
       bounds({0.07, None}, {0.07, None}, {0.1, None}), 20000},
      {"blocked 60 ms every 500 ms", {}, Kind::Plain, Blocked,
       bounds({0.001, None}, {0.001, None}, {0.003, None}), 60000},
      {"blocked 200 ms every 500 ms", {}, Kind::Plain, Blocked,
       bounds({0.001, None}, {0.001, None}, {0.001, None}), 200000},
      fast({"clean", {}, Kind::Plain, FastClean,
            bounds({None, None})}),
      fast({"clean, short pauses", {}, Kind::Plain, FastHidden,
            bounds({None, None})}),
      fast({"dropped 1/300", only(&Impairments::dropped, 1 / 300.), Kind::Plain, FastSeen,
            bounds({Missed, None}, {Missed, None}, {Missed, Deceived})}),
      fast({"inserted 1/500", only(&Impairments::inserted, 1 / 500.), Kind::Plain, FastSeen,
            bounds({Missed, Unsafe}, {Missed, Unsafe}, {Missed, 0.003, LowChannel})}),
      fast({"noise in 1/10 of the pauses", only(&Impairments::noise, 0.1), Kind::Plain, FastSeen,
            bounds({0.005, None, LikeInserted}, {0.003, None, LikeInserted}, {0.005, 2e-4, LikeInserted})}),
      fast({"joined midway", {}, Kind::Plain, FastJoin,
            bounds({None, None}), 0, true}),
      fast({"blocked 6 ms every 500 ms", {}, Kind::Plain, FastBlockedHalf,
            bounds({5e-4, None}, {5e-4, None}, {5e-4, 5e-5, Hidden}), 6000}),
      fast({"blocked 12 ms every 500 ms", {}, Kind::Plain, FastBlocked,
            bounds({0.003, None}, {0.003, None}, {0.01, None}), 12000}),
      fast({"blocked 20 ms every 500 ms", {}, Kind::Plain, FastBlocked,
            bounds({0.01, None}, {0.01, None}, {0.02, None}), 20000}),
      fast({"blocked 60 ms every 500 ms", {}, Kind::Plain, FastBlocked,
            bounds({0.001, None}, {0.001, None}, {0.001, None}), 60000}),
  };
  return list;
}

Run runOf(const Condition &condition, const Timing &timing, Sticks sticks) {
  Run run;
  run.line.impairments = condition.impairments;
  run.line.kind = condition.kind;
  run.line.sticks = sticks;
  run.line.baud = condition.baud;
  run.line.periodUs = timing.periodUs;
  run.loopUs = timing.loopUs;
  run.steady = condition.inStep;
  run.byteByByte = condition.byteByByte;
  run.blockUs = condition.blockUs;
  run.joining = condition.joining;
  return run;
}

Tally torture(const Condition &condition, const Timing &timing, Sticks sticks, Way way, uint64_t frames,
              uint64_t seed) {
  Run run = runOf(condition, timing, sticks);
  run.line.frames = frames;
  Random seeds(ownSeed(condition, timing, sticks, seed));
  if (condition.joining) {
    run.line.frames = 12;
  } else if (condition.inStep) {
    run.line.frames = 2000;
  }
  const uint32_t characterUs = run.line.characterUs();
  Tally sum;
  for (uint64_t i = 0; i < frames; i += run.line.frames) {
    if (condition.joining) {
      // At every character of a frame, and anywhere within it, over and over.
      run.joinUs = static_cast<uint32_t>(i / run.line.frames % 25 * characterUs + seeds.below(characterUs));
    }
    sum += simulate(run, way, seeds.next());  // in step, each begins at another place of a frame
  }
  return sum;
}

std::string name(const Timing &timing) {
  return "T = " + inMs(timing.periodUs) + ", loop() " +
         (timing.loopUs < 1000 ? std::to_string(timing.loopUs) + " us" : inMs(timing.loopUs));
}
