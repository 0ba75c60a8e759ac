// Runs the code of other-platforms.md on a line of known frames, 9 ms apart, polled every millisecond, from just before
// the clock wraps. The port hands bytes over in eights, or when two characters were idle. Ends with 0 if every number
// is right.
#include <cstdint>
#include <cstdio>
#include <vector>

#include "support/KnownFrames.h"

extern uint16_t channels[18];
void begin();
void poll();
bool mayFly();

namespace {

constexpr uint32_t CharacterUs = 120, PeriodUs = 9000;

uint32_t clockUs = UINT32_MAX - 20000;  // it wraps within the third frame
std::vector<uint8_t> port;
int failures = 0;

void expect(const char *what, long is, long wanted) {
  if (is != wanted) {
    std::printf("%s: %ld, expected %ld\n", what, is, wanted);
    failures++;
  }
}

void pollFor(uint32_t us) {
  for (uint32_t passed = 0; passed < us; passed += 1000) {
    clockUs += 1000;
    poll();
  }
}

// Brings the frame, and polls while it comes; the caller brings the silence behind it.
void send(const Frame &frame) {
  uint32_t us = 0;
  for (size_t sent = 0; sent < frame.size();) {
    us += CharacterUs;
    sent++;
    if (sent % 8 == 0) {
      port.insert(port.end(), frame.begin() + static_cast<long>(sent) - 8, frame.begin() + static_cast<long>(sent));
    }
    if (us >= 1000) {
      us -= 1000;
      clockUs += 1000;
      poll();
    }
  }
  port.push_back(frame.back());  // the 25th, after two idle characters: at the next poll
}

}  // namespace

int waitingBytes() { return static_cast<int>(port.size()); }

int readBytes(uint8_t *bytes, int count) {
  for (int i = 0; i < count; i++) {
    bytes[i] = port[static_cast<size_t>(i)];
  }
  port.erase(port.begin(), port.begin() + count);
  return count;
}

uint32_t microseconds() { return clockUs; }

int main() {
  begin();
  pollFor(20000);
  expect("may fly before the first frame", mayFly(), false);
  for (const KnownFrame &known : {PaperLow, PaperHigh, Neutral, PaperHigh, PaperLow}) {
    send(known.bytes);
    pollFor(PeriodUs - 3000);
    for (size_t i = 0; i < known.channels.size(); i++) {
      expect("channel", channels[i], known.channels[i]);
    }
    expect("may fly", mayFly(), true);
  }
  // After 12 ms without a poll, one poll takes all that has come.
  port.assign(Neutral.bytes.begin(), Neutral.bytes.end());
  port.insert(port.end(), PaperHigh.bytes.begin(), PaperHigh.bytes.end());
  clockUs += 12000;
  poll();
  expect("bytes left", waitingBytes(), 0);
  expect("CH3 after a blocked loop", channels[2], 1811);
  pollFor(120000);
  expect("may fly after 120 ms of silence", mayFly(), false);
  // After this silence the frame is not aligned: only idle(), since nothing follows, proves it.
  send(FailsafeFrame);
  pollFor(PeriodUs - 3000);
  expect("CH3 of the failsafe frame", channels[2], 172);
  expect("may fly in failsafe", mayFly(), false);
  std::printf("CH1 %d, CH3 %d, %d failures\n", channels[0], channels[2], failures);
  return failures != 0;
}
