// EEPROM: memory that keeps its contents without power; here only until the program ends.
#pragma once

#include <stddef.h>
#include <stdint.h>

namespace host {
uint8_t readEeprom(int address);
void writeEeprom(int address, const uint8_t *bytes, size_t size);  // takes as long as on the board
}  // namespace host

// A byte of the EEPROM, returned by EEPROM[address]: it reads as a uint8_t, and an assignment writes it.
class EERef {
 public:
  explicit EERef(int address) : _address(address) {}
  EERef(const EERef &) = default;

  operator uint8_t() const { return host::readEeprom(_address); }
  EERef &operator=(uint8_t value) {
    host::writeEeprom(_address, &value, 1);
    return *this;
  }
  EERef &operator=(const EERef &other) { return *this = static_cast<uint8_t>(other); }
  EERef &update(uint8_t value) { return *this = value; }

 private:
  const int _address;
};

// Addresses are 0..4095. Others read as 0, and ignore writes.
class EEPROMClass {
 public:
  EERef operator[](int address) { return EERef(address); }
  uint8_t read(int address) { return host::readEeprom(address); }
  void write(int address, uint8_t value) { host::writeEeprom(address, &value, 1); }
  void update(int address, uint8_t value) { write(address, value); }  // write() skips an equal byte
  static constexpr uint16_t length() { return 4096; }

  template <typename T>
  T &get(int address, T &value) {
    uint8_t *const bytes = reinterpret_cast<uint8_t *>(&value);
    for (size_t i = 0; i < sizeof(T); i++) {
      bytes[i] = host::readEeprom(address + static_cast<int>(i));
    }
    return value;
  }
  template <typename T>
  const T &put(int address, const T &value) {
    host::writeEeprom(address, reinterpret_cast<const uint8_t *>(&value), sizeof(T));
    return value;
  }
};

extern EEPROMClass EEPROM;
