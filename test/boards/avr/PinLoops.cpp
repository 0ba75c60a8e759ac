// A sketch that receives on an SBusPin, or with PORT on a hardware port, and counts for a second how often it does a
// piece of work: the EEPROM then begins with the number of loops, four bytes, and of new frames. At micros() 1600000
// and at millis() 1650 the LED flashes.

#include <Arduino.h>
#include <DecodeSBus.h>
#include <EEPROM.h>
#if !defined(PORT)
#include <SBusPin.h>
#endif

namespace {

#if defined(PORT)
DecodeSBus dSBus(Serial);
#else
SBusPin pin;
DecodeSBus dSBus(pin);
#endif
SBusFrame frame;

void flash() {
  digitalWrite(LED_BUILTIN, HIGH);
  digitalWrite(LED_BUILTIN, LOW);
}

}  // namespace

void setup() {
  pinMode(LED_BUILTIN, OUTPUT);
  dSBus.begin();
  while (millis() < 500) {
    dSBus.read(frame);
  }
  uint32_t loops = 0, frames = 0;
  while (millis() < 1500) {
    loops++;
    frames += dSBus.read(frame);
    for (volatile uint16_t i = 0; i < 300; i++) {
    }
  }
  EEPROM.put(0, loops);
  EEPROM.put(4, frames);
  while (micros() < 1600000) {
  }
  flash();
  while (millis() < 1650) {
  }
  flash();
}

void loop() {}
