// The EEPROM, and the file that it is kept in, which the host's --eeprom reads and writes, too.
#pragma once

#include <simavr/sim_avr.h>

#include <string>

#include "Mega.h"
#include "board/Eeprom.h"
#include "sbus/Calibration.h"

namespace mega {

class Eeprom {
 public:
  explicit Eeprom(Mega &mega);      // erased
  Eeprom(const Eeprom &) = delete;  // libsimavr has been given its address
  Eeprom &operator=(const Eeprom &) = delete;

  // Takes the contents from this file; if there is none, it is made. Throws std::runtime_error.
  void load(const std::string &file);

  // What the sketch Calibrate has stored, if it has.
  sbus::Calibration calibration() const;

  // Puts the contents into the file of load(), if there is one.
  void save();

 private:
  static void controlWritten(avr_t *avr, avr_io_addr_t address, uint8_t value, void *eeprom);
  static avr_cycle_count_t written(avr_t *avr, avr_cycle_count_t when, void *eeprom);

  Mega &_mega;
  host::Eeprom _kept;
  avr_io_write_t _writeControl = nullptr;  // libsimavr's own
  void *_parameter = nullptr;
};

}  // namespace mega
