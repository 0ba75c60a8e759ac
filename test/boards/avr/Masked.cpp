// A sketch that answers in all slots, and disables interrupts again and again, at random. (No .ino, as Background.cpp.)
// The EEPROM begins with two numbers of 16 bits: for how long at most, us, and the most time between, us. Sends every
// second
//   frames,sent,skipped,collisions  since the beginning

#include <Arduino.h>
#include <EEPROM.h>
#include <SBus2Sensor.h>
#include <elapsedMillis.h>

namespace {

const unsigned long PERIOD_DISPLAY = 1000;  // ms
const uint16_t SHORTEST = 10;               // us

elapsedMillis timerDisplay;
SBus2Sensor dSBus(Serial1);
uint16_t longestMask, mostApart;  // us
uint32_t state = 20181;

// Returns SHORTEST to `most`, the shorter ones more often.
uint16_t anyOf(uint16_t most) {
  state = state * 1664525 + 1013904223;
  const uint16_t part = static_cast<uint16_t>(state >> 16);
  const uint16_t range = static_cast<uint16_t>((uint32_t{part} * (most - SHORTEST)) >> 16);
  return static_cast<uint16_t>(SHORTEST + range);
}

void waitFor(uint16_t us) {
  for (; us > 1000; us = static_cast<uint16_t>(us - 1000)) {
    delayMicroseconds(1000);
  }
  delayMicroseconds(us);
}

}  // namespace

void setup() {
  Serial.begin(115200);
  EEPROM.get(0, longestMask);
  EEPROM.get(2, mostApart);
  dSBus.begin();
  for (uint8_t slot = 1; slot < sbus::SlotCount; slot++) {
    sbus::TemperatureF1713 temperature;
    temperature.degrees = slot;
    dSBus.writeSensor(slot, temperature);
  }
}

void loop() {
  const uint16_t masked = anyOf(anyOf(longestMask));
  noInterrupts();
  waitFor(masked);
  interrupts();
  waitFor(anyOf(mostApart));
  if (timerDisplay >= PERIOD_DISPLAY) {
    timerDisplay = 0;
    const uint32_t numbers[] = {dSBus.counters().frames, dSBus.sentSlots(), dSBus.skippedSlots()};
    for (const uint32_t number : numbers) {
      Serial.print(number);
      Serial.print(',');
    }
    Serial.println(dSBus.collisions());
  }
}
