// What the library costs on a Cortex-M0+, in instructions.
//   Bench known NAME=BYTES...   Markdown; the names are those of the functions that unpack, with their bytes of flash
//   Bench worst                 ... the worst call that a search finds
//   Bench check                 "ok bench: ..." and "FAILED bench: ...": the bounds below
//   Bench search TRIES SEED     looks for a worse call than those known
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <string>

#include "UnpackWays.h"
#include "Values.h"
#include "Worst.h"
#include "support/FakeClock.h"
#include "support/KnownFrames.h"

// Last: its macros min and max break the standard headers after it.
#include "CleanLine.h"

namespace {

// How long to look for the worst call of each size: eight times as many tries, with eight seeds, have found 3 % more.
constexpr uint32_t Tries = 20000;

// A tenth more than was measured with GCC 12.2 (bench.sh prints it).
constexpr uint32_t MostPerFrame = 359;  // parse, clean line, neutral sticks, a loop() of 50 us
constexpr uint32_t MostPerDecode = 162;
constexpr uint32_t MostPerCall = 5100;     // parse, 64 bytes
constexpr uint32_t MostPerByte = 203;      // parse, worst call of 16 bytes or more
constexpr unsigned MostTenthsLinear = 44;  // 64 bytes cost no more than 4.4 times what 16 cost

constexpr uint32_t MostPerSending = 597;      // EncodeSBus::write(), a frame
constexpr uint32_t MostPerNotDue = 35;        // ... too early
constexpr uint32_t MostPerScaling = 185;      // any integer one, any value
constexpr uint32_t MostPerCalibrated = 252;   // ... with dead zone
constexpr uint32_t MostPerFeeding = 626;      // Calibrator::feed()
constexpr uint32_t MostPerFinishing = 19000;  // Calibrator::finish()
constexpr uint32_t MostPerStateOf = 15000;    // of a stored calibration

constexpr size_t Sizes[] = {16, 32, 48, 64};

constexpr CleanLine CleanLines[] = {{992, 9000, 50}, {1024, 9000, 50}, {992, 9000, 3000}, {1024, 9000, 3000}};

bool failed = false;

void verdict(bool good, const char *what) {
  std::printf("%s bench: %s\n", good ? "ok" : "FAILED", what);
  failed = failed || !good;
}

void atMost(const std::string &what, uint32_t found, uint32_t most) {
  const bool good = found > 0 && found <= most;
  verdict(good, (what + ": " + std::to_string(found) + " instructions, at most " + std::to_string(most)).c_str());
}

uint32_t costOfDecode() {
  fakeMicros = 0;
  Ours ours;
  ours.receiver.begin();
  for (unsigned i = 0; i < 3; i++) {  // the first may wait for the next
    fakeMicros += 3500;
    take(ours, PaperLow.bytes.data(), PaperLow.bytes.size());
  }
  Channels channels = {};
  bool failsafe, lostFrame;
  const uint32_t cost = instructions::of([&] { ours.receiver.decodeSBusFrame(channels.data(), failsafe, lostFrame); });
  return channels == PaperLow.channels ? cost : 0;
}

// Per way: 0 if it does not give the frame's channels.
template <typename Unpack>
uint32_t costOfUnpacking(const Unpack &unpack) {
  alignas(4) static uint8_t padded[3 + 25];
  uint32_t most = 0;
  for (const KnownFrame &known : KnownFrames) {
    std::memcpy(padded + 3, known.bytes.data(), known.bytes.size());
    Channels channels = {};
    const uint32_t cost = instructions::of([&] { unpack(padded + 3, channels.data()); });
    if (channels != known.channels) {
      return 0;
    }
    most = cost > most ? cost : most;
  }
  return most;
}

uint32_t costOfPacking() {
  Frame frame = {};
  const uint32_t cost = instructions::of([&] { sbus::pack(frame.data(), PaperLow.channels.data(), false, false); });
  return frame == PaperLow.bytes ? cost : 0;
}

double perFrame(uint32_t number) {
  return static_cast<double>(number) / MeasuredFrames;
}

// After any lead and at any time.
Attack worstFound(size_t size) {
  const Attack one = search(size, Tries, 1);
  const Attack other = search(size, Tries, 2);
  return costOf(one, size, Way::Ours) > costOf(other, size, Way::Ours) ? one : other;
}

void printFrames() {
  std::printf("| per frame | ours | the paper's way |\n| --- | --- | --- |\n");
  for (const CleanLine &line : CleanLines) {
    const Cost ours = costOursOf(line);
    const Cost papers = costPapersOf(line);
    std::printf("| parse: clean line, 9 ms, loop() of %lu us, sticks at %u | %.0f | %.0f |\n",
                static_cast<unsigned long>(line.loopUs), line.centre, perFrame(ours.instructions),
                perFrame(papers.instructions));
    std::printf("| ... and calls of the port | %.1f | %.1f |\n", perFrame(ours.portCalls), perFrame(papers.portCalls));
  }
  std::printf("| decode: decodeSBusFrame() | %lu | - |\n", static_cast<unsigned long>(costOfDecode()));
  std::printf("| encode: sbus::pack() | %lu | - |\n", static_cast<unsigned long>(costOfPacking()));
}

void printValues() {
  const struct {
    const char *what;
    uint32_t cost;
  } rows[] = {
      {"`EncodeSBus::write()`: a frame is sent", costOfSending()},
      {"... too early for one", costOfNotDue()},
      {"`toMicroseconds()`", costOfMicroseconds()},
      {"`toNormalised()`", costOfNormalised()},
      {"... by a calibrated channel", costOfCalibrated()},
      {"`fromNormalised()`", costOfFromNormalised()},
      {"`toUnit()`, a float", costOfUnit()},
      {"`Calibrator::feed()`, 16 channels", costOfFeeding()},
      {"`Calibrator::finish()`, 16 channels", costOfFinishing()},
      {"`stateOf()` a stored calibration", costOfStateOf()},
  };
  std::printf("\n| sending, scaling, calibrating: the worst call | instructions |\n| --- | --- |\n");
  for (const auto &row : rows) {
    std::printf("| %s | %lu |\n", row.what, static_cast<unsigned long>(row.cost));
  }
}

void printBytes() {
  constexpr size_t Count = 4096;
  std::printf("\n| per byte of a line without a pause, 16 in a call | ours | the paper's way |\n| --- | --- | --- |\n");
  for (const BadLine &line : badLines()) {
    std::printf("| %s | %.1f | %.1f |\n", line.name, static_cast<double>(streamCost(line, Count, Way::Ours)) / Count,
                static_cast<double>(streamCost(line, Count, Way::Papers)) / Count);
  }
}

void printCalls() {
  std::printf(
      "\n| the worst call of parseSBusFrame() | 16 bytes | 32 | 48 | 64 | the paper's way, 64 |\n"
      "| --- | --- | --- | --- | --- | --- |\n");
  for (const BadLine &line : badLines()) {
    std::printf("| %s |", line.name);
    for (const size_t size : Sizes) {
      std::printf(" %lu |", static_cast<unsigned long>(worstOf(line, size, Way::Ours)));
    }
    std::printf(" %lu |\n", static_cast<unsigned long>(worstOf(line, LongestCall, Way::Papers)));
  }
}

void printWorst() {
  std::printf(
      "| the worst call that a search has found | 16 bytes | 32 | 48 | 64 | the paper's way, 64 |\n"
      "| --- | --- | --- | --- | --- | --- |\n| instructions |");
  Attack attack;
  for (const size_t size : Sizes) {
    attack = worstFound(size);
    std::printf(" %lu |", static_cast<unsigned long>(costOf(attack, size, Way::Ours)));
  }
  std::printf(" %lu |\n\nThe 64 bytes are those after the bar:",
              static_cast<unsigned long>(costOf(attack, LongestCall, Way::Papers)));
  print(attack, LongestCall);
}

const char *flash(const char *name, int argc, char **argv) {
  for (int i = 0; i < argc; i++) {
    const size_t length = std::strlen(name);
    if (std::strncmp(argv[i], name, length) == 0 && argv[i][length] == '=') {
      return argv[i] + length + 1;
    }
  }
  return "?";
}

void printWays(int argc, char **argv) {
  std::printf("\n| unpacking 18 channels | bytes of flash | instructions |\n| --- | --- | --- |\n");
  const struct {
    const char *what;
    const char *name;
    uint32_t cost;
  } rows[] = {
      {"bit by bit", "unpackBitByBit", costOfUnpacking(unpackBitByBit)},
      {"bytes shifted into a word", "unpackShifting", costOfUnpacking(unpackShifting)},
      {"byte by byte, written out: sbus::unpack()", "unpack", costOfUnpacking(sbus::unpack)},
      {"word by word, written out: sbus::unpackAligned()", "unpackAligned", costOfUnpacking(sbus::unpackAligned)},
  };
  for (const auto &row : rows) {
    std::printf("| %s | %s | %lu |\n", row.what, flash(row.name, argc, argv), static_cast<unsigned long>(row.cost));
  }
}

void print(int argc, char **argv) {
  std::printf(
      "arm-none-eabi-g++ %s. Every instruction counts, those of the call and of micros() with it; the port's own\n"
      "are subtracted, and its calls are counted instead: on a board they cost more than in memory.\n\n",
      __VERSION__);
  printFrames();
  printBytes();
  printCalls();
  printWays(argc, argv);
  printValues();
}

void check() {
  verdict(true, "300 instructions count as 300, and the port's are known");
  for (const CleanLine &line : CleanLines) {
    const Cost ours = costOursOf(line);
    atMost("a frame of a clean line, sticks at " + std::to_string(line.centre) + ", a loop() of " +
               std::to_string(line.loopUs) + " us",
           ours.instructions / MeasuredFrames, MostPerFrame);
    verdict(ours.frames == MeasuredFrames && costPapersOf(line).frames == MeasuredFrames,
            "... and each was taken in, by the paper's way, too");
  }
  atMost("decodeSBusFrame()", costOfDecode(), MostPerDecode);
  verdict(costOfUnpacking(unpackBitByBit) > 0 && costOfUnpacking(unpackShifting) > 0 &&
              costOfUnpacking(sbus::unpack) > 0 && costOfUnpacking(sbus::unpackAligned) > 0 && costOfPacking() > 0,
          "all ways of unpacking give the known channels");

  atMost("EncodeSBus::write(), a frame", costOfSending(), MostPerSending);
  atMost("... none due", costOfNotDue(), MostPerNotDue);
  atMost("toMicroseconds()", costOfMicroseconds(), MostPerScaling);
  atMost("toNormalised()", costOfNormalised(), MostPerScaling);
  atMost("fromNormalised()", costOfFromNormalised(), MostPerScaling);
  atMost("toNormalised() by a calibrated channel", costOfCalibrated(), MostPerCalibrated);
  verdict(costOfUnit() > costOfNormalised(), "toUnit() costs more than toNormalised()");
  atMost("Calibrator::feed()", costOfFeeding(), MostPerFeeding);
  atMost("Calibrator::finish()", costOfFinishing(), MostPerFinishing);
  atMost("stateOf() a stored calibration", costOfStateOf(), MostPerStateOf);

  for (const WorstCall &known : WorstCalls) {
    size_t size = 0;
    const Attack attack = attackOf(known, size);
    const uint32_t cost = costOf(attack, size, Way::Ours);
    atMost("the worst call known with " + std::to_string(size) + " bytes", cost, MostPerCall);
    atMost("... per byte", static_cast<uint32_t>(cost / size), MostPerByte);
  }
  for (const BadLine &line : badLines()) {
    const uint32_t linear = worstOf(line, Sizes[0], Way::Ours) * MostTenthsLinear / 10;
    atMost("64 bytes, no more than 4.4 times 16: " + std::string(line.name), worstOf(line, LongestCall, Way::Ours),
           linear < MostPerCall ? linear : MostPerCall);
  }
}

}  // namespace

int main(int argc, char **argv) {
  const char *const what = argc > 1 ? argv[1] : "known";
  if (!calibrate()) {
    verdict(false, "instructions cannot be counted here");
    return 1;
  }
  if (std::strcmp(what, "check") == 0) {
    check();
  } else if (std::strcmp(what, "worst") == 0) {
    printWorst();
  } else if (std::strcmp(what, "search") == 0 && argc > 3) {
    for (const size_t size : Sizes) {
      const Attack found = search(size, std::strtoul(argv[2], nullptr, 10), std::strtoul(argv[3], nullptr, 10));
      std::printf("%lu instructions:", static_cast<unsigned long>(costOf(found, size, Way::Ours)));
      print(found, size);
    }
  } else {
    print(argc, argv);
  }
  return failed ? 1 : 0;
}
