// A sketch that turns interrupts off again and again, as SoftwareSerial does while it writes, and a WS2812 strip whose
// show() runs in each loop(). (No .ino, as Background.cpp.) The EEPROM begins with four numbers of 16 bits: for how long,
// us; for how long they are on between two stops, us; how many stops follow each other; how often, ms. All channels of a
// frame are equal on its line. Sends every second
//   frames,wrong  since the beginning: new frames, and those whose channels differ

#include <Arduino.h>
#include <DecodeSBus.h>
#include <EEPROM.h>
#include <elapsedMillis.h>

namespace {

const unsigned long PERIOD_DISPLAY = 1000;  // ms

elapsedMillis timerDisplay, timerStops;
DecodeSBus dSBus(Serial1);
uint16_t stop, open, count, period;
unsigned long frames, wrong;

void waitFor(uint16_t us) {
  for (; us > 1000; us = static_cast<uint16_t>(us - 1000)) {
    delayMicroseconds(1000);
  }
  delayMicroseconds(us);
}

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
  EEPROM.get(0, stop);
  EEPROM.get(2, open);
  EEPROM.get(4, count);
  EEPROM.get(6, period);
  dSBus.begin();
}

void loop() {
  if (timerStops >= period) {
    timerStops = 0;
    for (uint16_t i = 0; i < count; i++) {
      noInterrupts();
      waitFor(stop);
      interrupts();
      waitFor(open);
    }
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
    Serial.print(frames);
    Serial.print(',');
    Serial.println(wrong);
  }
}
