#include "Pulses.h"

#include <simavr/avr_ioport.h>
#include <simavr/sim_io.h>

namespace mega {

namespace {

struct Place {
  char port;
  int bit;
};
constexpr Place Places[] = {{'E', 4}, {'E', 5}, {'G', 5}, {'E', 3}};  // of the pins 2..5

}  // namespace

Pulses::Pulses(Mega &mega, Expected &expected)
    : _mega(mega), _expected(expected), _pins{{this, 0}, {this, 1}, {this, 2}, {this, 3}} {
  for (Pin &pin : _pins) {
    const Place &place = Places[pin.channel];
    avr_irq_register_notify(avr_io_getirq(mega.avr(), AVR_IOCTL_IOPORT_GETIRQ(place.port), place.bit), changed, &pin);
  }
}

// Called whenever something is written to the port, be it to another pin.
void Pulses::changed(avr_irq_t *, uint32_t value, void *parameter) {
  Pin &pin = *static_cast<Pin *>(parameter);
  const Pulses &self = *pin.pulses;
  const bool high = (value & 1) != 0;
  if (high == pin.high) {
    return;
  }
  pin.high = high;
  const avr_cycle_count_t now = self._mega.avr()->cycle;
  if (high) {
    pin.rose = now;
    self._expected.pulseBegins(pin.channel);
  } else {
    self._expected.pulseEnds(pin.channel, static_cast<double>(now - pin.rose) / CyclesPerUs);
  }
}

}  // namespace mega
