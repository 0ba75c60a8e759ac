#include "LineOutput.h"

#include <simavr/sim_io.h>

namespace mega {

namespace {

constexpr uint32_t TransmitterOn = 0x08;  // TXENn of UCSRnB

}  // namespace

LineOutput::LineOutput(Mega &mega, int number) : _mega(mega), _number(number) {
  avr_t *const avr = mega.avr();
  const avr_uart_t &usart = mega.usart(number);
  avr_irq_register_notify(avr_iomem_getirq(avr, usart.r_ucsrb, nullptr, AVR_IOMEM_IRQ_ALL), controlWritten, this);
  avr_irq_register_notify(avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ(usart.name), UART_IRQ_OUTPUT), sent, this);
}

// The core sets baud rate and format first, then TXENn. libsimavr counts a parity bit that is not there, and misses a
// stop bit that is set after the baud rate: the time of a character is ours.
void LineOutput::controlWritten(avr_irq_t *, uint32_t value, void *output) {
  LineOutput &self = *static_cast<LineOutput *>(output);
  if ((value & TransmitterOn) == 0) {
    return;
  }
  const line::LineSettings settings = self._mega.settings(self._number);
  self._characterCycles = settings.format.bits() * (self._mega.avr()->frequency / settings.baud);
  self._mega.usart(self._number).cycles_per_byte = self._characterCycles;
  if (!(settings == self._settings)) {
    self._settings = settings;
    if (self._onSettings) {
      self._onSettings(settings);
    }
  }
}

// libsimavr has no UDRn in front of the shift register: there the next character would wait already when the one before
// it is through, and here it comes an interrupt later. It counts as back to back.
void LineOutput::sent(avr_irq_t *, uint32_t value, void *output) {
  LineOutput &self = *static_cast<LineOutput *>(output);
  const avr_cycle_count_t now = self._mega.avr()->cycle;
  const bool backToBack = now < self._end + self._characterCycles / 2;
  self._end = (backToBack ? self._end : now) + self._characterCycles;
  if (self._onCharacter) {
    self._onCharacter(static_cast<uint8_t>(value), self._end);
  }
}

}  // namespace mega
