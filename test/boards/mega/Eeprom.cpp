#include "Eeprom.h"

#include <simavr/avr_eeprom.h>
#include <simavr/sim_io.h>

#include <array>
#include <cstring>

namespace mega {

namespace {

constexpr avr_io_addr_t Control = 0x3F;  // EECR
constexpr uint8_t MasterEnable = 0x04;   // EEMPE
constexpr uint8_t Write = 0x02;          // EEPE
constexpr avr_cycle_count_t WriteCycles = 3300 * CyclesPerUs;

using Contents = std::array<uint8_t, host::Eeprom::Size>;

void transfer(avr_t *avr, uint32_t direction, Contents &contents) {
  avr_eeprom_desc_t description = {};
  description.ee = contents.data();
  description.size = host::Eeprom::Size;
  avr_ioctl(avr, direction, &description);
}

}  // namespace

Eeprom::Eeprom(Mega &mega) : _mega(mega) {
  auto &write = mega.avr()->io[AVR_DATA_TO_IO(Control)].w;
  _writeControl = write.c;
  _parameter = write.param;
  write.c = controlWritten;
  write.param = this;
}

// libsimavr writes in no time. EEPE stays set for as long as a byte really takes: a sketch that stores something waits
// for it, and misses frames meanwhile.
void Eeprom::controlWritten(avr_t *avr, avr_io_addr_t address, uint8_t value, void *eeprom) {
  Eeprom &self = *static_cast<Eeprom *>(eeprom);
  const bool enabled = (avr->data[address] & MasterEnable) != 0;
  self._writeControl(avr, address, value, self._parameter);
  if (enabled && (value & Write) != 0) {
    avr->data[address] |= Write;
    avr_cycle_timer_register(avr, WriteCycles, written, eeprom);
  }
}

avr_cycle_count_t Eeprom::written(avr_t *avr, avr_cycle_count_t, void *) {
  avr->data[Control] &= static_cast<uint8_t>(~Write);
  return 0;
}

void Eeprom::load(const std::string &file) {
  _kept.keepIn(file);
  Contents contents;
  for (size_t i = 0; i < contents.size(); i++) {
    contents[i] = _kept.read(static_cast<int>(i));
  }
  transfer(_mega.avr(), AVR_IOCTL_EEPROM_SET, contents);
}

sbus::Calibration Eeprom::calibration() const {
  sbus::Calibration calibration;
  avr_eeprom_desc_t description = {};  // of no bytes: libsimavr answers with a pointer to its own
  avr_ioctl(_mega.avr(), AVR_IOCTL_EEPROM_GET, &description);
  std::memcpy(&calibration, description.ee, sizeof calibration);
  return calibration;
}

void Eeprom::save() {
  Contents contents;
  transfer(_mega.avr(), AVR_IOCTL_EEPROM_GET, contents);
  _kept.write(0, contents.data(), contents.size());
}

}  // namespace mega
