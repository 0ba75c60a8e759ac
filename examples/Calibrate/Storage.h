// Keeps a value in the EEPROM, at its beginning, on all cores.
#pragma once

#include <Arduino.h>

// These cores have no EEPROM library. (__has_include would find none: the IDE looks only for what is included.)
#if defined(ARDUINO_ARCH_SAMD) || defined(ARDUINO_ARCH_SAM) || defined(ARDUINO_ARCH_NRF52) || defined(ARDUINO_ARCH_MBED)
struct NoEeprom {
  template <typename Value>
  void get(int, Value &) {}
  template <typename Value>
  void put(int, const Value &) {}
};
NoEeprom EEPROM;
#else
#include <EEPROM.h>
#endif

// ESP32, ESP8266 and arduino-pico have flash in its place: begin() reads it into RAM, commit() writes it, and end()
// forgets the RAM. The other cores have no such methods: there the second function of each pair is called.
template <typename Eeprom>
auto readFlash(Eeprom &eeprom, int) -> decltype(eeprom.begin(256), void()) {
  eeprom.begin(256);  // bytes: older arduino-picos write past the end of other sizes
}
template <typename Eeprom>
void readFlash(Eeprom &, long) {}
template <typename Eeprom>
auto writeFlash(Eeprom &eeprom, int) -> decltype(eeprom.commit(), void()) {
  eeprom.commit();
  eeprom.end();
}
template <typename Eeprom>
void writeFlash(Eeprom &, long) {}

// Reads the stored value. The value itself must show whether anything was stored.
template <typename Eeprom, typename Value>
void load(Eeprom &eeprom, Value &value) {
  readFlash(eeprom, 0);
  eeprom.get(0, value);
}

// Returns false if it cannot be read back. Writing blocks for 50 ms or more, and loses frames meanwhile.
template <typename Eeprom, typename Value>
bool store(Eeprom &eeprom, const Value &value) {
  eeprom.put(0, value);
  writeFlash(eeprom, 0);
  Value stored = Value();
  load(eeprom, stored);
  return memcmp(&stored, &value, sizeof value) == 0;
}
