// A sketch that receives on Serial1, and does what other libraries do. (No .ino, as Background.cpp.) The EEPROM's first
// byte is what, a Work. Prints each second
//   frames  since the beginning

#include <Arduino.h>
#include <DecodeSBus.h>
#include <EEPROM.h>
#include <SoftwareSerial.inc>
#include <elapsedMillis.h>

namespace {

enum Work : uint8_t { None, Leds, LedsAfter, Characters, CharactersAfter, Tone, Blocks };

const unsigned long PERIOD_DISPLAY = 1000;  // ms

DecodeSBus dSBus(Serial1);
SBusFrame frame;
SoftwareSerial other(10, 11);
elapsedMillis timerDisplay, timerWork;
uint8_t work;
unsigned pitch = 400;  // Hz

// As a library for WS2812 does, whose LEDs take 30 us each.
void show(unsigned leds) {
  noInterrupts();
  for (unsigned led = 0; led < leds; led++) {
    delayMicroseconds(30);
  }
  interrupts();
}

void print(unsigned characters) {
  while (characters-- > 0) {
    other.write('x');
  }
}

bool isTime(unsigned long ms) {
  if (timerWork < ms) {
    return false;
  }
  timerWork = 0;
  return true;
}

}  // namespace

void setup() {
  Serial.begin(115200);
  other.begin(9600);
  work = EEPROM.read(0);
  dSBus.begin();
}

void loop() {
  const bool isNew = dSBus.read(frame);
  if (work == Leds) {
    show(16);
  } else if (work == LedsAfter && isNew) {
    show(150);
  } else if (work == Characters && isTime(100)) {
    print(10);
  } else if (work == CharactersAfter && isNew) {
    print(3);
  } else if (work == Tone && isTime(10)) {
    tone(8, pitch ^= 2000);
  } else if (work == Blocks) {
    delay(25);
  }
  if (timerDisplay >= PERIOD_DISPLAY) {
    timerDisplay = 0;
    Serial.println(dSBus.counters().frames);
  }
}
