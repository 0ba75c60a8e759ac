// The paper's sketch: its calls of the library compile, letter by letter, and do what the paper shows.
#include <doctest/doctest.h>

#include <cstdio>
#include <string>

#include "support/FakeClock.h"
#include "support/KnownFrames.h"

#include "support/FakeSerial.h"

// As the paper includes them.
#include "DecodeSBus.h"
#include "elapsedMillis.h"

// In a namespace, so that its Serial and Serial1 are fakes and its setup() and loop() are called by the tests alone.
namespace paper {

struct FakeUsb {
  std::string sent;
  void begin(unsigned long) {}
  void print(const char *text) { sent += text; }
};

FakeUsb Serial;
FakeSerial Serial1;

// clang-format off
#define PERIOD_DISPLAY 200

uint16_t channels[18];
bool failsafe;
bool lostFrame;

elapsedMillis timerDisplay;

DecodeSBus dSBus(Serial1);

void serialEvent1(void)
{
   dSBus.parseSBusFrame();
}

void setup ()
{
  Serial.begin(115200);
  dSBus.begin();
}

void loop ()
{
  if (timerDisplay >= PERIOD_DISPLAY)
  {
    timerDisplay = 0;
    if (dSBus.SBusFrameOk())
    {
      dSBus.decodeSBusFrame(channels, failsafe, lostFrame);
      char tmp[48];  // the paper's 24 are one short of the longest line
      sprintf(tmp, "%i,%i,%i,%i,%i,%i\r", channels[0], channels[1], channels[2], channels[3],
        failsafe, lostFrame);
      Serial.print(tmp);
    }
  }
}
// clang-format on

}  // namespace paper

TEST_CASE("the paper's sketch prints the paper's channels, once in 200 ms") {
  fakeMicros = 0;
  paper::timerDisplay = 0;
  paper::setup();
  const Frame frames[] = {PaperLow.bytes, PaperHigh.bytes};
  for (const Frame &frame : frames) {
    for (unsigned ms = 0; ms < 200; ms += 10) {
      fakeMicros += 10000;
      paper::Serial1.arrive(frame);
      paper::loop();
      paper::serialEvent1();
    }
  }
  paper::loop();
  CHECK(paper::Serial.sent == "995,992,172,992,0,0\r995,993,1811,992,0,0\r");
}
