// The cost of frames on a line without faults, as the board hands them over: to find, to decode, and to pack them.
#include "Bench.h"

#include <algorithm>
#include <cstdio>

#include "board/BoardUart.h"
#include "support/FakeClock.h"
#include "support/KnownFrames.h"

#include "Cost.h"  // last: Arduino.h has a type named byte

namespace {

// GCC 12.2 needs 755 and 239: millis() is some 70 of each, for boards that sleep, and the gaps of stretched frames 70.
constexpr uint32_t MostPerFrame = 830;  // neutral sticks, a loop() of 50 us
constexpr uint32_t MostPerDecode = 250;

constexpr uint32_t PeriodUs = 9000;
constexpr unsigned FramesAhead = 32;  // after these the driver's ring begins again
constexpr unsigned MeasuredFrames = 96;
constexpr size_t Characters = (FramesAhead + MeasuredFrames) * sbus::FrameSize;

constexpr struct CleanLine {
  uint16_t centre;  // of the sticks: 992 has 0F in the payload, 1024 has not
  uint32_t loopUs;
} CleanLines[] = {{992, 50}, {1024, 50}, {992, 3000}, {1024, 3000}};

line::Character character(const CleanLine &line, size_t number) {
  const auto frame = static_cast<unsigned>(number / sbus::FrameSize);
  const size_t index = number % sbus::FrameSize;
  line::Character character;
  character.endUs = uint64_t{frame} * PeriodUs + 1000 + (index + 1) * line::CharacterUs;
  character.value = countingFrame(line.centre, 900, frame, 0x00)[index];
  return character;
}

// The receiver is called after a call of loop() if bytes wait.
template <typename Receiver>
Cost costOf(const CleanLine &line) {
  fakeMicros = 0;
  Receiver both;
  both.receiver.begin();
  host::BoardUart uart;
  uart.open(0);
  Cost measured;
  line::Character next = character(line, 0);
  for (size_t sent = 0; fakeMicros < (FramesAhead + MeasuredFrames) * PeriodUs;) {
    fakeMicros += line.loopUs;
    while (sent < Characters && next.endUs <= fakeMicros) {
      uart.receive(next);
      next = character(line, ++sent);
    }
    uart.advance(fakeMicros);
    uint8_t bytes[host::BoardUart::BufferSize];
    const auto count = static_cast<size_t>(uart.read(bytes, sizeof bytes));
    const Cost cost = count > 0 ? take(both, bytes, count) : Cost();
    measured += sent > FramesAhead * sbus::FrameSize ? cost : Cost();
  }
  return measured;
}

uint32_t costOfDecoding() {
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

uint32_t costOfPacking() {
  Frame frame = {};
  const uint32_t cost = instructions::of([&] { sbus::pack(frame.data(), PaperLow.channels.data(), false, false); });
  return frame == PaperLow.bytes ? cost : 0;
}

// Returns 0 if it does not give the known frames' channels.
template <typename Unpack>
uint32_t costOfUnpacking(const Unpack &unpack) {
  alignas(4) static uint8_t padded[3 + 25];
  uint32_t most = 0;
  for (const KnownFrame &known : KnownFrames) {
    std::copy(known.bytes.begin(), known.bytes.end(), padded + 3);
    Channels channels = {};
    const uint32_t cost = instructions::of([&] { unpack(padded + 3, channels.data()); });
    if (channels != known.channels) {
      return 0;
    }
    most = cost > most ? cost : most;
  }
  return most;
}

double perFrame(uint32_t number) { return static_cast<double>(number) / MeasuredFrames; }

}  // namespace

void printFrames() {
  std::printf("| per frame | ours | the baseline |\n| --- | --- | --- |\n");
  for (const CleanLine &line : CleanLines) {
    const Cost ours = costOf<Ours>(line);
    const Cost papers = costOf<Papers>(line);
    std::printf("| parse: clean line, 9 ms, loop() of %lu us, sticks at %u | %.0f | %.0f |\n",
                static_cast<unsigned long>(line.loopUs), line.centre, perFrame(ours.instructions),
                perFrame(papers.instructions));
    std::printf("| ... and calls of the port | %.1f | %.1f |\n", perFrame(ours.portCalls), perFrame(papers.portCalls));
  }
  std::printf("| decode: decodeSBusFrame() | %lu | - |\n", static_cast<unsigned long>(costOfDecoding()));
  std::printf("| sbus::unpack(), sbus::unpackAligned() | %lu, %lu | - |\n",
              static_cast<unsigned long>(costOfUnpacking(sbus::unpack)),
              static_cast<unsigned long>(costOfUnpacking(sbus::unpackAligned)));
  std::printf("| encode: sbus::pack() | %lu | - |\n", static_cast<unsigned long>(costOfPacking()));
}

void checkFrames() {
  for (const CleanLine &line : CleanLines) {
    const Cost ours = costOf<Ours>(line);
    atMost("a frame of a clean line, sticks at " + std::to_string(line.centre) + ", a loop() of " +
               std::to_string(line.loopUs) + " us",
           ours.instructions / MeasuredFrames, MostPerFrame);
    verdict(ours.frames == MeasuredFrames && costOf<Papers>(line).frames == MeasuredFrames,
            "... and each was taken in, by the baseline as well");
  }
  atMost("decodeSBusFrame()", costOfDecoding(), MostPerDecode);
  verdict(costOfPacking() > 0, "pack() gives the known bytes");
}
