// What the example Calibrate stores, on cores with an EEPROM, and on those with flash in its place.
#include <doctest/doctest.h>

#include <cstdint>
#include <cstring>

#include "../../examples/Calibrate/Storage.h"

namespace {

constexpr size_t Size = 256;

// The AVR's EEPROM: put() stores. Its begin() is that of a range of bytes.
struct Plain {
  uint8_t cells[Size] = {};
  bool broken = false;  // stores nothing

  uint8_t *begin() { return cells; }
  template <typename Value>
  void get(int address, Value &value) {
    std::memcpy(&value, cells + address, sizeof value);
  }
  template <typename Value>
  void put(int address, const Value &value) {
    if (!broken) {
      std::memcpy(cells + address, &value, sizeof value);
    }
  }
};

// The EEPROM of ESP32, ESP8266 and arduino-pico: before begin(size) there is nothing, and without commit() nothing
// stays.
struct InFlash {
  uint8_t flash[Size] = {};
  uint8_t copy[Size] = {};
  size_t size = 0;  // of the copy
  bool broken = false;

  void begin(size_t wanted) {
    if (size == 0) {  // a second begin() need not read again
      size = wanted;
      std::memcpy(copy, flash, size);
    }
  }
  bool commit() {
    if (size != 0 && !broken) {
      std::memcpy(flash, copy, size);
    }
    return size != 0 && !broken;
  }
  bool end() {
    size = 0;
    return true;
  }
  template <typename Value>
  void get(int address, Value &value) {
    if (static_cast<size_t>(address) + sizeof value <= size) {
      std::memcpy(&value, copy + address, sizeof value);
    }
  }
  template <typename Value>
  void put(int address, const Value &value) {
    if (static_cast<size_t>(address) + sizeof value <= size) {
      std::memcpy(copy + address, &value, sizeof value);
    }
  }
};

// The sketch: loads when it starts, stores, and starts again.
template <typename Eeprom>
void check(bool broken) {
  Eeprom eeprom;
  eeprom.broken = broken;
  uint32_t value = 1;
  load(eeprom, value);
  CHECK(value == 0);
  CHECK(store(eeprom, uint32_t{0x12345678}) == !broken);
  CHECK(store(eeprom, uint32_t{0x87654321}) == !broken);
  load(eeprom, value);
  CHECK(value == (broken ? 0 : 0x87654321));
}

}  // namespace

TEST_CASE("a stored value is read back; a value that could not be stored is reported as not stored") {
  check<Plain>(false);
  check<Plain>(true);
  check<InFlash>(false);
  check<InFlash>(true);
}

TEST_CASE("the value is in the flash, not only in its copy in RAM") {
  InFlash eeprom;
  uint32_t value = 1;
  load(eeprom, value);
  REQUIRE(store(eeprom, uint32_t{0x12345678}));
  std::memcpy(&value, eeprom.flash, sizeof value);
  CHECK(value == 0x12345678);
}
