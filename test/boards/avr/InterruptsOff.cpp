// A sketch that turns interrupts off now and then, as one that drives a WS2812 strip of 310 LEDs does, for 9.3 to 9.56
// ms. (No .ino, as Background.cpp.) All channels of a frame are equal on its line. Sends every second
//   stops,frames,wrong  since the beginning: times that they were off, new frames, and those whose channels differ

#include <Arduino.h>
#include <DecodeSBus.h>
#include <elapsedMillis.h>

namespace {

const unsigned long PERIOD_DISPLAY = 1000;  // ms
const unsigned int SHORTEST_STOP = 9300;    // us
const unsigned int LONGEST_STOP = 9560;     // us
const unsigned int STEP = 4;                // us
const unsigned long PERIOD_STOP = 57;       // ms

elapsedMillis timerDisplay, timerStop;
DecodeSBus dSBus(Serial1);
unsigned int stop = SHORTEST_STOP;  // us
unsigned long stops, frames, wrong;

bool areEqual(const uint16_t channels[]) {
  for (int i = 1; i < 16; i++) {
    if (channels[i] != channels[0]) {
      return false;
    }
  }
  return true;
}

}  // namespace

void setup() {
  Serial.begin(115200);
  dSBus.begin();
}

void loop() {
  if (timerStop >= PERIOD_STOP) {
    timerStop = 0;
    noInterrupts();
    delayMicroseconds(stop);
    interrupts();
    stops++;
    stop = stop < LONGEST_STOP ? stop + STEP : SHORTEST_STOP;
  }
  dSBus.parseSBusFrame();
  if (dSBus.newFrame()) {
    uint16_t channels[18];
    bool failsafe, lostFrame;
    dSBus.decodeSBusFrame(channels, failsafe, lostFrame);
    frames++;
    wrong += areEqual(channels) ? 0 : 1;
  }
  if (timerDisplay >= PERIOD_DISPLAY) {
    timerDisplay = 0;
    Serial.print(stops);
    Serial.print(',');
    Serial.print(frames);
    Serial.print(',');
    Serial.println(wrong);
  }
}
