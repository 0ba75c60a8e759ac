// What the library makes of a recording, as the page's "Save CSV" writes it: seconds, CH1..CH16, switches, flags. It
// polls after each character, as a sketch whose loop() is fast.
#include <cstdio>
#include <string>

#include "line/RecordingFile.h"
#include "sbus/FrameFinder.h"

int main(int, char **arguments) {
  std::string header = "seconds";
  for (int channel = 1; channel <= sbus::ProportionalCount; channel++) {
    header += ",CH" + std::to_string(channel);
  }
  std::puts((header + ",switch17,switch18,failsafe,lostFrame").c_str());
  sbus::FrameFinder finder;
  for (const line::Character character : line::readRecording(arguments[1]).characters) {
    finder.poll(1, static_cast<uint32_t>(character.endUs));
    *finder.space() = character.value;
    const uint8_t *const frame = finder.received(1, 0);
    if (frame == nullptr) {
      continue;
    }
    uint16_t channels[sbus::ChannelCount];
    sbus::unpack(frame, channels);
    // The first frame of a line waits for what follows it.
    std::printf("%.6f", static_cast<double>(character.endUs) / 1e6);
    for (const uint16_t channel : channels) {
      std::printf(",%u", channel);
    }
    std::printf(",%d,%d\n", sbus::failsafe(frame), sbus::lostFrame(frame));
  }
}
