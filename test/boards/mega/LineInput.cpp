#include "LineInput.h"

#include <simavr/sim_io.h>

namespace mega {

namespace {

constexpr uint32_t ReceiverOn = 0x10;  // RXEN1 of UCSR1B
constexpr size_t HardwareBuffer = 3;   // characters that the USART holds: two, and one in its shift register

// libsimavr has one time for the characters that a USART receives and those that it sends. Ours come when they are
// through: while it takes or gives one of these, a character lasts a cycle. What is sent keeps its time.
class AtOnce {
 public:
  explicit AtOnce(avr_uart_t &usart) : _usart(usart), _cycles(usart.cycles_per_byte) { _usart.cycles_per_byte = 1; }
  ~AtOnce() { _usart.cycles_per_byte = _cycles; }
  AtOnce(const AtOnce &) = delete;
  AtOnce &operator=(const AtOnce &) = delete;

 private:
  avr_uart_t &_usart;
  const avr_cycle_count_t _cycles;
};

}  // namespace

LineInput::LineInput(Mega &mega, line::Line &line) : _mega(mega), _usart(mega.usart(1)), _line(line) {
  avr_irq_register_notify(avr_iomem_getirq(mega.avr(), _usart.r_ucsrb, nullptr, AVR_IOMEM_IRQ_ALL), controlWritten,
                          this);
  hook(_usart.r_ucsra, statusRead, _readStatus);
  hook(_usart.r_udr, dataRead, _readData);
}

// libsimavr lets nobody register where it reads itself; so ours stands in front, and calls it.
void LineInput::hook(avr_io_addr_t address, avr_io_read_t ours, avr_io_read_t &theirs) {
  auto &read = _mega.avr()->io[AVR_DATA_TO_IO(address)].r;
  theirs = read.c;
  read.c = ours;
  read.param = this;
}

void LineInput::controlWritten(avr_irq_t *, uint32_t value, void *input) {
  LineInput &self = *static_cast<LineInput *>(input);
  const bool open = (value & ReceiverOn) != 0;
  if (open && !self._open) {
    self.open();
  }
  self._open = open;
}

// The core sets baud rate and format first, then RXEN1.
void LineInput::open() {
  _openedUs = _mega.clockUs();
  settle();
  _framesSinceOpen = 0;
  _bad.clear();
  if (!_everOpen) {
    _everOpen = true;
    _line.opened(_openedUs);
    look();
  }
}

void LineInput::settle() {
  const line::LineSettings settings = _mega.settings(1);
  _mismatch = line::mismatch(settings, _wire);
  _sampler.open(_mega.clockUs(), settings, _wire);
}

void LineInput::rewire(const line::LineSettings &wire) {
  _wire = wire;
  if (_open) {
    settle();
  }
}

void LineInput::look() {
  if (!_everOpen || _isComing) {
    return;
  }
  while (fetch() && toCycle(_next.endUs) <= _mega.avr()->cycle) {
    // it was sent before the port was first opened
  }
  if (_isComing) {
    avr_cycle_timer_register(_mega.avr(), toCycle(_next.endUs) - _mega.avr()->cycle, characterThrough, this);
  }
}

bool LineInput::fetch() {
  _isComing = _line.next(UINT64_MAX, _next);
  return _isComing;
}

avr_cycle_count_t LineInput::characterThrough(avr_t *, avr_cycle_count_t, void *input) {
  LineInput &self = *static_cast<LineInput *>(input);
  self.count(self._next);
  if (self._open) {
    self.put(self._next);
  }
  return self.fetch() ? self.toCycle(self._next.endUs) : 0;
}

void LineInput::count(const line::Character &character) {
  const uint64_t beganUs = character.endUs - _wire.characterUs();
  if (beganUs > _lastEndUs) {
    _run = 0;
    _runBad = false;
    _runBeganUs = beganUs;
  }
  _lastEndUs = character.endUs;
  if (_run < _frame.size()) {
    _frame[_run] = character.value;
  }
  _run++;
  _runBad = _runBad || character.bad;
  _characters++;
  _badCharacters += character.bad;
  if (_run == _frame.size() && !_runBad) {
    _frames++;
    _lastFrameUs = character.endUs;
    _framesSinceOpen += _runBeganUs >= _openedUs;
    if (_onFrame) {
      _onFrame(_frame);
    }
  }
}

void LineInput::put(const line::Character &character) {
  if (_mismatch.empty()) {
    if (character.endUs >= _openedUs + _wire.characterUs()) {
      receive(character);
    }
    return;
  }
  _wrongSettings = _mismatch;
  _sampler.put(character);
  line::Character seen;
  while (_sampler.next(character.endUs, seen)) {
    receive(seen);
  }
}

void LineInput::receive(const line::Character &character) {
  forgetRead();
  if (_bad.size() == HardwareBuffer) {
    _overruns++;
    return;
  }
  _bad.push_back(character.bad);
  // libsimavr takes a character for one that begins now, and raises RXC1 a character's time later: 110 us, because it
  // does not notice two stop bits that are set after the baud rate. It would also hand over at once what is after a
  // character that was fetched late. The time is ours: RXC1 is raised in the next cycle.
  const AtOnce atOnce(_usart);
  avr_raise_irq(avr_io_getirq(_mega.avr(), AVR_IOCTL_UART_GETIRQ('1'), UART_IRQ_INPUT), character.value);
}

// A port that is closed forgets what was not fetched.
void LineInput::forgetRead() {
  if (_usart.input.read == _usart.input.write) {
    _bad.clear();
  }
}

// UPE1 is that of the character which UDR1 gives next. libsimavr has no parity; it only leaves the bit alone.
uint8_t LineInput::statusRead(avr_t *avr, avr_io_addr_t address, void *input) {
  LineInput &self = *static_cast<LineInput *>(input);
  self.forgetRead();
  const avr_regbit_t &upe = self._usart.upe;
  const uint8_t mask = static_cast<uint8_t>(upe.mask << upe.bit);
  const bool bad = !self._bad.empty() && self._bad.front();
  avr->data[upe.reg] = static_cast<uint8_t>((avr->data[upe.reg] & ~mask) | (bad ? mask : 0));
  return self._readStatus(avr, address, &self._usart);
}

uint8_t LineInput::dataRead(avr_t *avr, avr_io_addr_t address, void *input) {
  LineInput &self = *static_cast<LineInput *>(input);
  if (!self._bad.empty()) {
    self._bad.pop_front();
  }
  const AtOnce atOnce(self._usart);
  const uint8_t value = self._readData(avr, address, &self._usart);
  if (!self._bad.empty()) {
    avr_raise_interrupt(avr, &self._usart.rxc);  // libsimavr would do so a character's time later
  }
  return value;
}

}  // namespace mega
