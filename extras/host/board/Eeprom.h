// The memory that keeps its contents without power: between two runs in a file, if it has one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace host {

class Eeprom {
 public:
  static constexpr size_t Size = 4096;  // the core offers this part of the board's 6 KB

  Eeprom();
  ~Eeprom();
  Eeprom(const Eeprom &) = delete;
  Eeprom &operator=(const Eeprom &) = delete;

  // Keeps the contents in this file; creates an erased one if it is missing. Throws std::runtime_error.
  void keepIn(const std::string &file);

  // Returns a byte; 0 if the address does not exist. write() does nothing there.
  uint8_t read(int address) const;

  // Writes, also to the file. Returns how long the sketch has to wait, in us.
  uint64_t write(int address, const uint8_t *bytes, size_t size);

 private:
  void save(size_t address);

  std::vector<uint8_t> _bytes;
  std::string _file;
  int _handle = -1;
};

}  // namespace host
