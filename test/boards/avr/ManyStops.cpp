// A sketch that turns interrupts off again and again, as SoftwareSerial does while it writes, and a WS2812 strip whose
// show() runs in each loop(). (No .ino, as Background.cpp.) The EEPROM begins with four numbers of 16 bits: for how
// long, us; for how long they are on between two stops, us; how many stops follow each other; how often, ms. A fifth:
// 1: the times are random, up to these. All channels of a frame are equal on its line. Sends every second
//   frames,wrong  since the beginning: new frames, and those whose channels differ

#include <Arduino.h>
#include <EEPROM.h>
#include <elapsedMillis.h>
#if defined(IN_BACKGROUND)
#include <DecodeSBusBackground.h>
#else
#include <DecodeSBus.h>
#endif

namespace {

const unsigned long PERIOD_DISPLAY = 1000;  // ms

elapsedMillis timerDisplay, timerStops;
#if defined(IN_BACKGROUND)
DecodeSBusBackground dSBus(Serial1);
#else
DecodeSBus dSBus(Serial1);
#endif
uint16_t stop, open, count, period, isRandom;
uint32_t state = 20181;
unsigned long frames, wrong;

uint16_t upTo(uint16_t us) {
  state = state * 1664525 + 1013904223;
  return isRandom != 0 ? static_cast<uint16_t>(1 + (((state >> 16) * us) >> 16)) : us;
}

void waitFor(uint16_t us) {
  for (; us > 1000; us = static_cast<uint16_t>(us - 1000)) {
    delayMicroseconds(1000);
  }
  delayMicroseconds(us);
}

void turnOff() {
  for (uint16_t i = 0; i < count; i++) {
    const uint16_t us = upTo(stop);
    noInterrupts();
    waitFor(us);
    interrupts();
    waitFor(upTo(open));
  }
}

bool areEqual(const SBusFrame &frame) {
  for (int i = 1; i < 16; i++) {
    if (frame.channels[i] != frame.channels[0]) {
      return false;
    }
  }
  return frame.channels[16] == 0 && frame.channels[17] == 0 && !frame.failsafe && !frame.lostFrame;
}

}  // namespace

void setup() {
  Serial.begin(115200);
  EEPROM.get(0, stop);
  EEPROM.get(2, open);
  EEPROM.get(4, count);
  EEPROM.get(6, period);
  EEPROM.get(8, isRandom);
  dSBus.begin();
}

void loop() {
  if (timerStops >= period) {
    timerStops = 0;
    turnOff();
  }
  SBusFrame frame;
  if (dSBus.read(frame)) {
    frames++;
    wrong += areEqual(frame) ? 0 : 1;
  }
  if (timerDisplay >= PERIOD_DISPLAY) {
    timerDisplay = 0;
    Serial.print(frames);
    Serial.print(',');
    Serial.println(wrong);
  }
}
