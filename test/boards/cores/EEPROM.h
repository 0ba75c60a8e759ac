// EEPROM.h of the cores that have one. EEPROM_EMULATED: it needs begin(), commit() and end().
#pragma once

#include <Arduino.h>

#if defined(NO_EEPROM)
#error "this core has no EEPROM.h"
#endif

class EEPROMClass {
 public:
#if defined(EEPROM_EMULATED)
  bool begin(size_t size);
  bool commit();
  bool end();
#endif
  uint8_t read(int address);
  void write(int address, uint8_t value);
  uint16_t length();
  template <typename T>
  T &get(int, T &value) {
    return value;
  }
  template <typename T>
  const T &put(int, const T &value) {
    return value;
  }
};
extern EEPROMClass EEPROM;
