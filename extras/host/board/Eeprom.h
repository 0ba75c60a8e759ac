// The EEPROM: it is erased when the program starts.
#pragma once

#include <cstddef>
#include <cstdint>

namespace host {

class Eeprom {
 public:
  static constexpr size_t Size = 4096;  // the core offers this part of the board's 6 KB

  // Returns a byte; 0 if the address does not exist. write() does nothing there.
  uint8_t read(int address) const { return exists(address) ? _bytes[address] : 0; }

  // Writes what changes. Returns how long the sketch has to wait, in us.
  uint64_t write(int address, const uint8_t *bytes, size_t size) {
    constexpr int WordSize = 4;
    constexpr uint64_t WordUs = 3300;  // the approximate time to write a word
    uint64_t us = 0;
    int lastWord = -1;
    for (size_t i = 0; i < size; i++, address++) {
      if (!exists(address) || _bytes[address] == bytes[i]) {
        continue;
      }
      _bytes[address] = bytes[i];
      if (address / WordSize != lastWord) {
        lastWord = address / WordSize;
        us += WordUs;
      }
    }
    return us;
  }

 private:
  static bool exists(int address) { return address >= 0 && address < static_cast<int>(Size); }

  uint8_t _bytes[Size] = {};  // erased: 00
};

}  // namespace host
