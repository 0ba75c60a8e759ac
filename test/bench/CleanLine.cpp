#include "board/BoardUart.h"
#include "support/FakeClock.h"
#include "support/KnownFrames.h"

// Last: its macros min and max break the standard headers after it.
#include "CleanLine.h"

namespace {

constexpr unsigned FramesAhead = 32;
constexpr unsigned Frames = FramesAhead + MeasuredFrames;

template <typename Both>
Cost costOf(const CleanLine &line) {
  fakeMicros = 0;
  Both both;
  both.receiver.begin();
  host::BoardUart uart;
  uart.open(0);
  Cost measured;
  for (unsigned number = 0; number < Frames; number++) {
    const Frame frame = countingFrame(line.centre, 900, number, 0x00);
    const uint64_t startUs = uint64_t{number} * line.periodUs + 1000;
    unsigned sent = 0;
    Cost cost;
    while (fakeMicros < startUs + line.periodUs) {
      fakeMicros += line.loopUs;
      for (; sent < frame.size() && startUs + (sent + 1) * line::CharacterUs <= fakeMicros; sent++) {
        line::Character character;
        character.endUs = startUs + (sent + 1) * line::CharacterUs;
        character.value = frame[sent];
        uart.receive(character);
      }
      uart.advance(fakeMicros);
      uint8_t bytes[host::BoardUart::BufferSize];
      const int count = uart.read(bytes, sizeof bytes);
      if (count > 0) {
        cost.add(take(both, bytes, static_cast<size_t>(count)));
      }
    }
    if (number >= FramesAhead) {
      measured.add(cost);
    }
  }
  return measured;
}

}  // namespace

Cost costOursOf(const CleanLine &line) {
  return costOf<Ours>(line);
}

Cost costPapersOf(const CleanLine &line) {
  return costOf<Papers>(line);
}
