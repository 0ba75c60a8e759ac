// A sketch that receives on an SBusPin, and checks each frame: channel i is channel 0 plus 37 i. (No .ino, as
// Background.cpp.) The EEPROM begins with numbers of 16 bits: for how long interrupts are off, at least and at most,
// us; in one of how many loops; delay() in each loop, ms; if not 0, how far the masks are apart, us, instead; what else
// happens then, instead: 1 timer 1 is set to 0, 2 its capture unit is set to the other edge. Prints five times a second
//   frames,wrong,overflows  since the beginning
// and in between lines of 40 characters, 50 a second.

#include <Arduino.h>
#include <DecodeSBus.h>
#include <EEPROM.h>
#include <SBusPin.h>
#include <elapsedMillis.h>
#if defined(BACKGROUND)
#include <DecodeSBusBackground.h>
#endif

namespace {

const unsigned long PERIOD_DISPLAY = 20;  // ms

SBusPin pin;
#if defined(BACKGROUND)
DecodeSBusBackground dSBus(pin);
#else
DecodeSBus dSBus(pin);
#endif
SBusFrame frame;
elapsedMillis timerDisplay;
uint16_t shortest, longest, loops, pause, apart, meddles;
uint32_t wrong, state = 20181;
uint32_t masked = 6500;  // us: in step with the test's frames of 9 ms, 1.5 ms after the beginning of one
uint8_t rows;

// Returns a number below `end`.
uint16_t below(uint16_t end) {
  state = state * 1664525 + 1013904223;
  return static_cast<uint16_t>((state >> 16) * end >> 16);
}

// Returns true if it is time for the next mask.
bool isDue() {
  if (apart == 0) {
    return below(loops) == 0;
  }
  if (static_cast<int32_t>(micros() - masked) < static_cast<int32_t>(apart)) {
    return false;
  }
  masked += apart;
  return true;
}

void disturb() {
  if (meddles == 1) {
    TCNT1 = 0;
  } else if (meddles == 2) {
    TCCR1B ^= _BV(ICES1);
  } else {
    uint16_t us = static_cast<uint16_t>(shortest + below(static_cast<uint16_t>(longest - shortest + 1)));
    noInterrupts();
    for (; us > 1000; us = static_cast<uint16_t>(us - 1000)) {
      delayMicroseconds(1000);
    }
    delayMicroseconds(us);
    interrupts();
  }
}

}  // namespace

void setup() {
  Serial.begin(115200);
  EEPROM.get(0, shortest);
  EEPROM.get(2, longest);
  EEPROM.get(4, loops);
  EEPROM.get(6, pause);
  EEPROM.get(8, apart);
  EEPROM.get(10, meddles);
  dSBus.begin();
}

void loop() {
  if (dSBus.read(frame)) {
    bool isRight = true;
    for (uint8_t i = 1; i < 16; i++) {
      isRight = isRight && frame.channels[i] == ((frame.channels[0] + 37 * i) & 2047);
    }
    wrong += !isRight;
  }
  if (loops != 0 && isDue()) {
    disturb();
  }
  if (pause != 0) {
    delay(pause);
  }
  if (timerDisplay >= PERIOD_DISPLAY && Serial.availableForWrite() > 42) {
    timerDisplay = 0;
    if (++rows % 10 == 0) {
      const sbus::Counters counters = dSBus.counters();
      Serial.print(counters.frames);
      Serial.print(',');
      Serial.print(wrong);
      Serial.print(',');
      Serial.println(counters.overflows);
    } else {
      Serial.println(F("the quick brown fox jumps over this dog"));
    }
  }
}
