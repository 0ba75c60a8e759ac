// Prints what the library decodes from a recording, as the page's "Save CSV" writes it: time, CH1..CH16, switches,
// flags. It polls after each character, and once before, when nothing has come: as a sketch whose loop() is fast does.
#include <cstdio>
#include <string>

#include "line/recording/RecordingFile.h"
#include "sbus/FrameFinder.h"

namespace {

void print(const uint8_t *frame, uint64_t us) {
  if (frame == nullptr) {
    return;
  }
  uint16_t channels[sbus::ChannelCount];
  sbus::unpack(frame, channels);
  std::printf("%.6f", static_cast<double>(us) / 1e6);
  for (const uint16_t channel : channels) {
    std::printf(",%u", channel);
  }
  std::printf(",%d,%d\n", sbus::failsafe(frame), sbus::lostFrame(frame));
}

}  // namespace

int main(int, char **arguments) {
  std::string header = "time";
  for (int channel = 1; channel <= sbus::ProportionalCount; channel++) {
    header += ",CH" + std::to_string(channel);
  }
  std::puts((header + ",CH17,CH18,failsafe,lostframe").c_str());
  sbus::FrameFinder finder;
  uint64_t us = 0;
  for (const line::Character character : line::readRecording(arguments[1]).characters) {
    us = character.endUs;
    print(finder.idle(static_cast<uint32_t>(us - 1)), us - 1);
    finder.poll(1, static_cast<uint32_t>(us));
    *finder.space() = character.value;
    print(finder.received(1, 0), us);
  }
  print(finder.idle(static_cast<uint32_t>(us + 4000)), us + 4000);
}
