#include "Mega.h"

#include <simavr/avr_extint.h>
#include <simavr/sim_elf.h>
#include <simavr/sim_io.h>

#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "line/Line.h"

namespace mega {

namespace {

constexpr char Processor[] = "atmega2560";
constexpr uint8_t ExternalInterrupts = 8;     // INT0..INT7
constexpr avr_io_addr_t TimerControl = 0x45;  // TCCR0B
constexpr uint32_t TimerClocked = 0x07;       // CS02:CS00, 0 while it stands still

// libsimavr talks on standard output, which is the sketch's.
void log(avr_t *, int level, const char *format, va_list arguments) {
  if (level == LOG_ERROR || level == LOG_WARNING) {
    std::vfprintf(stderr, format, arguments);
  }
}

void doNotSleep(avr_t *, avr_cycle_count_t) {
}

bool isSet(const avr_t *avr, const avr_regbit_t &bits) {
  return (avr->data[bits.reg] >> bits.bit & bits.mask) != 0;
}

}  // namespace

Mega::Mega(const std::string &elf) {
  avr_global_logger_set(log);
  _avr = avr_make_mcu_by_name(Processor);
  if (_avr == nullptr) {
    throw std::runtime_error(std::string("this libsimavr knows no ") + Processor);
  }
  avr_init(_avr);
  _avr->sleep = doNotSleep;            // else a sketch that waits for an interrupt waits in real time
  _avr->run_cycle_limit = UINT32_MAX;  // instructions run in one go, up to the next event; as exact, and faster
  for (uint8_t number = 0; number < ExternalInterrupts; number++) {
    avr_extint_set_strict_lvl_trig(_avr, number, 0);  // else it looks in every cycle whether such a pin is still low
  }
  load(elf);
  findUsarts();
  avr_irq_register_notify(avr_iomem_getirq(_avr, TimerControl, nullptr, AVR_IOMEM_IRQ_ALL), timerStarted, this);
}

Mega::~Mega() {
  avr_terminate(_avr);
}

void Mega::load(const std::string &elf) {
  elf_firmware_t firmware = {};
  if (elf_read_firmware(elf.c_str(), &firmware) != 0 || firmware.flashsize == 0) {
    throw std::runtime_error(elf + ": cannot be read; an .elf file for the " + Processor + " is expected");
  }
  avr_load_firmware(_avr, &firmware);
  _avr->frequency = CyclesPerUs * 1000000;
}

void Mega::findUsarts() {
  for (avr_io_t *io = _avr->io_port; io != nullptr; io = io->next) {
    if (std::strcmp(io->kind, "uart") == 0) {
      avr_uart_t *const usart = reinterpret_cast<avr_uart_t *>(io);  // its first member
      usart->flags = 0;  // neither sleep in real time while the sketch waits, nor print what it sends
      if (usart->name >= '0' && usart->name < '0' + UsartCount) {
        _usarts[usart->name - '0'] = usart;
      }
    }
  }
}

void Mega::run() {
  constexpr avr_cycle_count_t Stretch = line::CharacterUs * CyclesPerUs;
  const avr_cycle_count_t end = _avr->cycle + Stretch;
  while (_avr->cycle < end) {
    const int state = avr_run(_avr);
    if (state == cpu_Done || state == cpu_Crashed) {
      throw std::runtime_error("the sketch has crashed at pc " + std::to_string(_avr->pc));
    }
  }
}

line::LineSettings Mega::settings(int number) const {
  const avr_uart_t &usart = *_usarts[number];
  const uint8_t *const data = _avr->data;
  const unsigned divisor = 1 + (data[usart.ubrrl.reg] | (data[usart.ubrrh.reg] & 0x0Fu) << 8);
  const unsigned samples = isSet(_avr, usart.u2x) ? 8 : 16;  // per bit
  const unsigned format = data[usart.r_ucsrc];
  constexpr line::Parity Parities[] = {line::Parity::None, line::Parity::None, line::Parity::Even, line::Parity::Odd};
  line::LineSettings settings;
  settings.baud = _avr->frequency / (samples * divisor);
  settings.format.dataBits = (format >> 1 & 3) == 3 ? 8 : 7;
  settings.format.parity = Parities[format >> 4 & 3];
  settings.format.stopBits = (format >> 3 & 1) != 0 ? 2 : 1;
  return settings;
}

void Mega::timerStarted(avr_irq_t *, uint32_t value, void *mega) {
  Mega &self = *static_cast<Mega *>(mega);
  if ((value & TimerClocked) != 0) {
    self._clockZero = self._avr->cycle;
  }
}

}  // namespace mega
