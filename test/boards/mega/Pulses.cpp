#include "Pulses.h"

#include <simavr/avr_ioport.h>
#include <simavr/sim_io.h>

#include <stdexcept>

namespace mega {

namespace {

struct Place {
  char port;
  int bit;
};
constexpr Place Places[] = {{'E', 4}, {'E', 5}, {'G', 5}, {'E', 3}};  // of the pins 2..5

}  // namespace

Pulses::Pulses(Mega &mega, const LineInput &line, const std::string &file)
    : _mega(mega),
      _line(line),
      _pins{{this, 2}, {this, 3}, {this, 4}, {this, 5}},
      _file(std::fopen(file.c_str(), "w")) {
  if (_file == nullptr) {
    throw std::runtime_error(file + ": cannot be written");
  }
  for (Pin &pin : _pins) {
    const Place &place = Places[pin.number - 2];
    avr_irq_register_notify(avr_io_getirq(mega.avr(), AVR_IOCTL_IOPORT_GETIRQ(place.port), place.bit), changed, &pin);
  }
}

Pulses::~Pulses() {
  std::fclose(_file);
}

// Called whenever something is written to the port, be it to another pin.
void Pulses::changed(avr_irq_t *, uint32_t value, void *parameter) {
  Pin &pin = *static_cast<Pin *>(parameter);
  const bool high = (value & 1) != 0;
  if (high == pin.high) {
    return;
  }
  pin.high = high;
  const Pulses &self = *pin.pulses;
  const avr_cycle_count_t now = self._mega.avr()->cycle;
  if (high) {
    pin.rose = now;
    return;
  }
  const double width = static_cast<double>(now - pin.rose) / CyclesPerUs;
  std::fprintf(self._file, "%d,%.4f,%.4f\n", pin.number, self.toUs(pin.rose), width);
}

void Pulses::lineBegins() {
  std::fprintf(_file, "line,%.4f\n", toUs(_mega.avr()->cycle));
}

double Pulses::toUs(avr_cycle_count_t cycle) const {
  return (static_cast<double>(cycle) - static_cast<double>(_line.toCycle(0))) / CyclesPerUs;
}

}  // namespace mega
