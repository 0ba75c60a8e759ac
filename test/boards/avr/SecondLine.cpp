#include "SecondLine.h"

#include <simavr/sim_io.h>
#include <simavr/sim_regbit.h>

#include <utility>

namespace avr {

SecondLine::SecondLine(avr_t *avr, avr_uart_t &usart, std::unique_ptr<line::Line> source,
                       std::function<line::LineSettings()> settings, std::function<uint64_t()> clockUs)
    : _avr(avr),
      _usart(usart),
      _source(std::move(source)),
      _settings(std::move(settings)),
      _clockUs(std::move(clockUs)) {
  auto &read = _avr->io[AVR_DATA_TO_IO(_usart.r_udr)].r;
  read.c = dataRead;
  read.param = this;
}

void SecondLine::control(bool isOn) {
  const line::LineSettings now = _settings();
  if (!isOn || (_isOpen && now == _opened)) {
    return;  // the sketch does not close it
  }
  _opened = now;
  _sampler.open(_clockUs(), now, {});
  _received.clear();
  show();
  if (!_isOpen) {
    _isOpen = true;
    _source->opened(_clockUs());
    avr_cycle_timer_register(_avr, PollCycles, poll, this);
  }
}

avr_cycle_count_t SecondLine::poll(avr_t *, avr_cycle_count_t when, void *line) {
  SecondLine &self = *static_cast<SecondLine *>(line);
  for (line::Character character; self._source->next(self._clockUs(), character);) {
    self._characters.push_back(character);
    self._sampler.put(character);
    for (line::Character seen; self._sampler.next(character.endUs, seen);) {
      if (self._received.size() == HardwareBuffer) {
        self._lost++;
      } else {
        self._received.push_back(seen);
      }
    }
    self.show();
  }
  return when + PollCycles;
}

// As AvrBoard::showReceived().
void SecondLine::show() {
  avr_regbit_setto(_avr, _usart.upe, !_received.empty() && _received.front().bad);
  if (_received.empty()) {
    avr_regbit_clear(_avr, _usart.rxc.raised);
    avr_clear_interrupt(_avr, &_usart.rxc);
  } else {
    avr_raise_interrupt(_avr, &_usart.rxc);
  }
}

uint8_t SecondLine::dataRead(avr_t *, avr_io_addr_t, void *line) {
  SecondLine &self = *static_cast<SecondLine *>(line);
  if (self._received.empty()) {
    return 0;
  }
  const uint8_t value = self._received.front().value;
  self._received.pop_front();
  self.show();
  return value;
}

}  // namespace avr
