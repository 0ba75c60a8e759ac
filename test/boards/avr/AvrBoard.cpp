#include "AvrBoard.h"

#include <simavr/avr_eeprom.h>
#include <simavr/avr_extint.h>
#include <simavr/avr_ioport.h>
#include <simavr/avr_timer.h>
#include <simavr/sim_elf.h>
#include <simavr/sim_io.h>
#include <simavr/sim_regbit.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace avr {

namespace {

constexpr uint32_t CyclesPerUs = 16;
constexpr avr_cycle_count_t Never = avr_cycle_count_t{1} << 60;
constexpr avr_cycle_count_t PollCycles = 10 * CyclesPerUs;  // of a silent line
constexpr uint64_t AheadUs = 20;                            // a pin's character is drawn so much before it begins
constexpr uint32_t HighMillivolts = 3300;
constexpr avr_cycle_count_t SharedPollCycles = 2 * CyclesPerUs;  // of a line that hands characters over at their end
constexpr uint8_t ExternalInterrupts = 8;                        // INT0..INT7
constexpr avr_io_addr_t TimerControl = 0x45;                     // TCCR0B
constexpr uint32_t TimerClocked = 0x07;                          // CS02:CS00, 0 while it stands still
constexpr uint32_t ReceiverOn = 0x10;                            // RXENn of UCSRnB
constexpr uint32_t TransmitterOn = 0x08;                         // TXENn
constexpr avr_io_addr_t CompareFlags = 0x36;                     // TIFR1,
constexpr avr_io_addr_t CompareInterrupts = 0x6F;                // TIMSK1,
constexpr uint32_t CompareMatch = 0x02;                          // and their bits OCF1A, OCIE1A
constexpr uint8_t Untouched = 0xA5;                              // RAM
constexpr size_t LeastRam = 64;       // bytes between variables and stack that no sketch may touch
constexpr size_t HardwareBuffer = 3;  // characters that the USART holds: two, and one in its shift register

// The expected settings of Serial: 115200 baud, as near as 16 MHz come to it (2.1 %), 8N1.
bool isSerial(const line::LineSettings &settings) {
  return std::labs(static_cast<long>(settings.baud) - 115200) <= 115200 / 40 &&
         settings.format == line::Format{8, line::Parity::None, 1};
}

}  // namespace

AvrBoard::AvrBoard(const Model &model, const std::string &sketch, Line line, double seconds,
                   std::vector<uint8_t> eeprom)
    : _model(model), _avr(avr_make_mcu_by_name(model.chip)), _line(std::move(line)) {
  avr_global_logger_set([](avr_t *, int, const char *, va_list) {});
  avr_init(_avr);
  _avr->sleep = [](avr_t *, avr_cycle_count_t) {};  // otherwise waiting for an interrupt takes real time
  _avr->run_cycle_limit = UINT32_MAX;               // instructions run in one go, up to the next event
  for (uint8_t number = 0; number < ExternalInterrupts; number++) {
    avr_extint_set_strict_lvl_trig(_avr, number, 0);  // otherwise such a pin is polled in every cycle
  }
  load(sketch);
  findUsarts();
  mendTimers();
  mendComparator();
  on(written(TimerControl), [this](uint32_t value) { _clockZero = (value & TimerClocked) != 0 ? _avr->cycle : 0; });
  for (size_t number = 0; number < None; number++) {
    if (_usarts[number] == nullptr) {
      continue;
    }
    const avr_uart_t &usart = *_usarts[number];
    on(written(usart.r_ucsrb), [this, number](uint32_t value) { control(number, value); });
    on(avr_io_getirq(_avr, AVR_IOCTL_UART_GETIRQ(static_cast<uint32_t>(usart.name)), UART_IRQ_OUTPUT),
       [this, number](uint32_t value) { send(number, static_cast<uint8_t>(value)); });
  }
  if (_usart != nullptr) {
    auto &read = _avr->io[AVR_DATA_TO_IO(_usart->r_udr)].r;
    read.c = dataRead;
    read.param = this;
  }
  if (_line.second) {
    const size_t number = _line.secondUsart;
    _second = std::make_unique<SecondLine>(
        _avr, *_usarts[number], std::move(_line.second), [this, number] { return settings(number); },
        [this] { return clockUs(_avr->cycle); });
  }
  for (size_t pin = 0; pin < 4; pin++) {
    on(port(_model.servos[pin]), [this, pin](uint32_t value) { edge(pin, (value & 1) != 0); });
  }
  on(port(_model.led), [this](uint32_t value) { edge(Led, (value & 1) != 0); });
  // The compare unit moves its pin at a match, which raises OCF1A first. Libsimavr 1.6 also moves it when OCR1A is
  // written (avr_timer.c, avr_timer_comp_on_tov()), as only the overflow of a PWM does.
  on(avr_io_getirq(_avr, AVR_IOCTL_TIMER_GETIRQ('1'), TIMER_IRQ_OUT_COMP), [this](uint32_t value) {
    if ((_avr->data[CompareFlags] & _avr->data[CompareInterrupts] & CompareMatch) != 0) {
      edge(OC1A, (value & 1) != 0);
    }
  });
  _usb.connect(
      _avr, [this](uint8_t byte) { print(byte); },
      [this](uint8_t endpoint, const std::vector<uint8_t> &bytes) {
        if (endpoint == UsbHost::ReportIn) {
          _reports.push_back({clockUs(_avr->cycle), bytes});
        }
      });
  if (!_line.levels.empty()) {
    avr_cycle_timer_register(_avr, 1, levelChanges, this);
  }
  avr_eeprom_desc_t description = {eeprom.data(), 0, static_cast<uint32_t>(eeprom.size())};
  avr_ioctl(_avr, AVR_IOCTL_EEPROM_SET, &description);
  run(seconds);
}

AvrBoard::~AvrBoard() { avr_terminate(_avr); }

void AvrBoard::load(const std::string &sketch) {
  const std::string file = std::string(ELVES "/") + _model.name + "/" + sketch + ".elf";
  elf_firmware_t firmware = {};
  if (elf_read_firmware(file.c_str(), &firmware) != 0 || firmware.flashsize == 0) {
    throw std::runtime_error(file + " cannot be read");
  }
  avr_load_firmware(_avr, &firmware);
  _variablesEnd = _avr->ioend + 1u + firmware.datasize + firmware.bsssize;
  std::fill(_avr->data + _variablesEnd, _avr->data + _avr->ramend + 1, Untouched);
  _avr->frequency = CyclesPerUs * 1000000;
}

void AvrBoard::findUsarts() {
  for (avr_io_t *io = _avr->io_port; io != nullptr; io = io->next) {
    if (std::strcmp(io->kind, "uart") == 0) {
      avr_uart_t *const usart = reinterpret_cast<avr_uart_t *>(io);  // its first member
      usart->flags = 0;  // neither sleep in real time while the sketch waits, nor print what it sends
      _usarts[usart->name - '0'] = usart;
    }
  }
  _usart = _model.receiver != None ? _usarts[_model.receiver] : nullptr;
}

// Libsimavr 1.6 clears all flags of TIFRn at a write to it (avr_timer.c, avr_timer_write_pending()), a chip only those
// that are written as 1. And it forgets an interrupt that is disabled while it waits: enabled again, a chip serves it.
void AvrBoard::mendTimers() {
  for (avr_io_t *io = _avr->io_port; io != nullptr; io = io->next) {
    avr_timer_t *const timer = reinterpret_cast<avr_timer_t *>(io);
    if (std::strcmp(io->kind, "timer") != 0 || timer->name > '1') {
      continue;
    }
    on(written(timer->overflow.enable.reg), [this, timer](uint32_t) {
      if (avr_regbit_get(_avr, timer->overflow.enable) != 0 && avr_regbit_get(_avr, timer->overflow.raised) != 0) {
        avr_raise_interrupt(_avr, &timer->overflow);
      }
    });
    auto &write = _avr->io[AVR_DATA_TO_IO(timer->overflow.raised.reg)].w;
    write.param = timer;
    write.c = [](avr_t *avr, avr_io_addr_t, uint8_t value, void *param) {
      avr_timer_t &self = *static_cast<avr_timer_t *>(param);
      const auto clear = [avr, value](avr_int_vector_t &vector) {
        if ((value >> vector.raised.bit & 1) != 0) {
          avr_clear_interrupt(avr, &vector);
        }
      };
      clear(self.overflow);
      clear(self.icr);
      for (avr_timer_comp_t &unit : self.comp) {
        if (unit.interrupt.vector != 0) {
          clear(unit.interrupt);
        }
      }
    };
  }
}

// Libsimavr 1.6 has none in an ATmega2560. Its registers are where a 328P has them; its interrupt is number 28.
avr_acomp_t *AvrBoard::addComparator() {
  constexpr unsigned Control = 0x50;  // ACSR
  const auto bit = [](unsigned number) {
    avr_regbit_t found = {};
    found.reg = Control;
    found.bit = number & 7;
    found.mask = 1;
    return found;
  };
  avr_acomp_t &added = _added;
  added.r_acsr = Control;
  added.acis[0] = bit(0);
  added.acis[1] = bit(1);
  added.acic = bit(2);
  added.ac.enable = bit(3);
  added.ac.raised = bit(4);
  added.ac.vector = 28;
  added.aco = bit(5);
  added.acbg = bit(6);
  added.disabled = bit(7);
  added.timer_name = '1';
  avr_acomp_init(_avr, &added);
  added.io.reset(&added.io);
  return &added;
}

// Libsimavr 1.6 sets ACI and ACO as they are written; a chip clears ACI by a 1, and ACO is read-only.
void AvrBoard::mendComparator() {
  if (_model.receiver != None) {
    return;
  }
  for (avr_io_t *io = _avr->io_port; io != nullptr; io = io->next) {
    if (std::strcmp(io->kind, "ac") == 0) {
      _comparator = reinterpret_cast<avr_acomp_t *>(io);
    }
  }
  if (_comparator == nullptr) {
    _comparator = addComparator();
  }
  on(avr_io_getirq(_avr, AVR_IOCTL_ACOMP_GETIRQ, ACOMP_IRQ_OUT), [this](uint32_t value) { _isHigh = value != 0; });
  avr_register_io_write(
      _avr, _comparator->r_acsr,
      [](avr_t *, avr_io_addr_t, uint8_t value, void *board) { static_cast<AvrBoard *>(board)->compare(value); }, this);
}

// The sketch has written `control` to ACSR.
void AvrBoard::compare(uint8_t control) {
  constexpr uint8_t Flag = 0x10, Output = 0x20, Captures = 0x04;
  uint8_t &now = _avr->data[_comparator->r_acsr];
  now = static_cast<uint8_t>((now & ~((control & Flag) | Output)) | (_isHigh ? Output : 0));
  const bool wasOpen = _isOpen;
  _isOpen = (control & Captures) != 0;
  if (_isOpen && !wasOpen) {
    avr_raise_irq(_comparator->timer_irq, _isHigh ? 1 : 0);  // libsimavr's timer knows it only after a change
    open();
  }
}

void AvrBoard::setLine(bool isHigh) {
  avr_raise_irq(avr_io_getirq(_avr, AVR_IOCTL_ACOMP_GETIRQ, ACOMP_IRQ_AIN1), isHigh ? HighMillivolts : 0);
}

// Adds the edges of a character.
void AvrBoard::draw(const line::Character &character) {
  constexpr uint32_t Bits = 12;
  const unsigned parity = static_cast<unsigned>(__builtin_parity(character.value)) ^ (character.bad ? 1u : 0u);
  const unsigned bits = unsigned{character.value} << 1 | parity << 9 | 3u << 10;
  const avr_cycle_count_t begins = _clockZero + (character.endUs - line::CharacterUs) * CyclesPerUs;
  bool wasHigh = false;
  for (uint32_t bit = 0; bit < Bits; bit++) {
    const bool isHigh = (bits >> bit & 1) == 0;
    if (isHigh != wasHigh) {
      _edges.push_back({begins + bit * line::CharacterUs * CyclesPerUs / Bits, isHigh});
      wasHigh = isHigh;
    }
  }
  avr_cycle_timer_cancel(_avr, edgeComes, this);
  avr_cycle_timer_register(_avr, std::max<avr_cycle_count_t>(_edges.front().cycle, _avr->cycle + 1) - _avr->cycle,
                           edgeComes, this);
}

avr_cycle_count_t AvrBoard::edgeComes(avr_t *, avr_cycle_count_t when, void *board) {
  AvrBoard &self = *static_cast<AvrBoard *>(board);
  while (!self._edges.empty() && self._edges.front().cycle <= when) {
    self.setLine(self._edges.front().isHigh);
    self._edges.pop_front();
  }
  return self._edges.empty() ? 0 : self._edges.front().cycle;
}

avr_irq_t *AvrBoard::port(const Pin &pin) const {
  return avr_io_getirq(_avr, AVR_IOCTL_IOPORT_GETIRQ(static_cast<uint32_t>(pin.port)), pin.bit);
}

avr_irq_t *AvrBoard::written(avr_io_addr_t address) const {
  return avr_iomem_getirq(_avr, address, nullptr, AVR_IOMEM_IRQ_ALL);
}

void AvrBoard::on(avr_irq_t *irq, std::function<void(uint32_t)> callback) {
  _callbacks.push_back(std::move(callback));
  const auto call = [](avr_irq_t *, uint32_t value, void *to) {
    (*static_cast<std::function<void(uint32_t)> *>(to))(value);
  };
  avr_irq_register_notify(irq, call, &_callbacks.back());
}

void AvrBoard::run(double seconds) {
  const auto end = static_cast<uint64_t>(seconds * 1e6);
  for (uint64_t us = 0; us < end; us = clockUs(_avr->cycle)) {
    const int state = avr_run(_avr);
    if (state == cpu_Done || state == cpu_Crashed) {
      throw std::runtime_error("the sketch has crashed at pc " + std::to_string(_avr->pc));
    }
  }
}

uint64_t AvrBoard::clockUs(avr_cycle_count_t cycle) const { return (cycle - _clockZero) / CyclesPerUs; }

std::vector<uint8_t> AvrBoard::eeprom() const {
  std::vector<uint8_t> bytes(_model.eepromBytes);
  avr_eeprom_desc_t description = {bytes.data(), 0, static_cast<uint32_t>(bytes.size())};
  avr_ioctl(_avr, AVR_IOCTL_EEPROM_GET, &description);
  return bytes;
}

size_t AvrBoard::unusedRam() const {
  const uint8_t *const end = _avr->data + _avr->ramend + 1, *const variablesEnd = _avr->data + _variablesEnd;
  return static_cast<size_t>(std::find_if(variablesEnd, end, [](uint8_t byte) { return byte != Untouched; }) -
                             variablesEnd);
}

std::string AvrBoard::mistakes() const {
  std::string all;
  for (size_t number = 0; number < None; number++) {
    all += _mismatch[number].empty() ? "" : "USART" + std::to_string(number) + ": " + _mismatch[number] + "\n";
  }
  if (unusedRam() < LeastRam) {
    all += "RAM: " + std::to_string(unusedRam()) + " bytes between variables and stack\n";
  }
  if (_second && _second->lost() > 0) {
    all += "second line: " + std::to_string(_second->lost()) + " characters were not read in time\n";
  }
  return all + (_lost == 0 ? ""
                           : "USART" + std::to_string(_model.receiver) + ": " + std::to_string(_lost) +
                                 " characters were not read in time\n");
}

// Returns what the port's registers say.
line::LineSettings AvrBoard::settings(size_t number) const {
  constexpr line::Parity Parities[] = {line::Parity::None, line::Parity::None, line::Parity::Even, line::Parity::Odd};
  const avr_uart_t &usart = *_usarts[number];
  const uint32_t divisor = 1u + _avr->data[usart.ubrrl.reg] + 256u * (_avr->data[usart.ubrrh.reg] & 0x0Fu);
  const unsigned format = _avr->data[usart.r_ucsrc];
  line::LineSettings settings;
  settings.baud = _avr->frequency / ((avr_regbit_get(_avr, usart.u2x) != 0 ? 8 : 16) * divisor);
  settings.format.dataBits = 5 + (format >> 1 & 3);
  settings.format.parity = Parities[format >> 4 & 3];
  settings.format.stopBits = 1 + (format >> 3 & 1);
  return settings;
}

// The core sets baud rate and format first, then RXENn and TXENn. libsimavr counts a parity bit that is not there, and
// misses a stop bit that is set after the baud rate: we calculate the time of a character. Nor does it raise UDREn
// before all has been sent (1.6, avr_uart.c, avr_uart_txc_raise()): its own timer never elapses, and shifted() does
// that.
void AvrBoard::control(size_t number, uint32_t value) {
  avr_uart_t &usart = *_usarts[number];
  if ((value & TransmitterOn) != 0) {
    const line::LineSettings now = settings(number);
    _transmitters[number].usart = &usart;
    _transmitters[number].character = now.format.bits() * (_avr->frequency / now.baud);
    usart.cycles_per_byte = Never;
    if (!_transmitters[number].hasNext) {
      avr_raise_interrupt(_avr, &usart.udrc);  // also when UDRIEn is set
    }
  }
  if (_second && number == _line.secondUsart) {
    _second->control((value & ReceiverOn) != 0);
  }
  if (number == _model.receiver) {
    const bool asBefore = _isOpen && settings(number) == _settings;
    _isOpen = (value & ReceiverOn) != 0;
    if (_isOpen && !asBefore) {
      open();
    }
  }
}

void AvrBoard::open() {
  const uint64_t us = clockUs(_avr->cycle);
  _settings = _usart != nullptr ? settings(_model.receiver) : line::LineSettings();
  _sampler.open(us, _settings, {});
  _received.clear();
  if (_usart != nullptr) {
    showReceived();
  }
  if (_opened.empty()) {
    if (_line.source) {
      _line.source->opened(us);
      _line.source->share({});
    }
    avr_cycle_timer_register(_avr, 1, characterThrough, this);
  }
  _opened.push_back(us);
}

bool AvrBoard::next(line::Character &character) {
  if (_line.source) {
    const uint64_t ahead = line::CharacterUs + (_usart == nullptr ? AheadUs : 0);
    return _line.source->next(std::min(_line.cutUs, clockUs(_avr->cycle) + ahead), character);
  }
  if (_wire.empty()) {
    return false;
  }
  character = _wire.front();
  _wire.pop_front();
  return true;
}

avr_cycle_count_t AvrBoard::characterThrough(avr_t *, avr_cycle_count_t when, void *board) {
  AvrBoard &self = *static_cast<AvrBoard *>(board);
  if (self._isComing) {
    self._characters.push_back(self._next);
    self.receive(self._next);
  }
  do {
    self._isComing = self.next(self._next);
  } while (self._isComing && self._next.endUs <= self._opened[0]);
  if (self._isComing && self._usart == nullptr) {
    self.draw(self._next);
  }
  const avr_cycle_count_t poll = when + (self._line.isShared ? SharedPollCycles : PollCycles);
  return self._isComing ? std::max(self._clockZero + self._next.endUs * CyclesPerUs, when + 1) : poll;
}

avr_cycle_count_t AvrBoard::levelChanges(avr_t *, avr_cycle_count_t when, void *board) {
  AvrBoard &self = *static_cast<AvrBoard *>(board);
  const std::vector<Level> &levels = self._line.levels;
  const auto cycleOf = [](const Level &level) { return static_cast<avr_cycle_count_t>(level.us * CyclesPerUs); };
  while (self._nextLevel < levels.size() && cycleOf(levels[self._nextLevel]) <= when) {
    const Level &level = levels[self._nextLevel++];
    if (level.pin == SBusInput) {
      self.setLine(level.isHigh);
    } else {
      avr_raise_irq(self.port(self._model.inputs[level.pin]), level.isHigh ? 1 : 0);
    }
  }
  return self._nextLevel < levels.size() ? cycleOf(levels[self._nextLevel]) : 0;
}

void AvrBoard::receive(const line::Character &character) {
  if (!_isOpen || _usart == nullptr) {
    return;
  }
  if (const std::string mismatch = line::mismatch(settings(_model.receiver), {}); !mismatch.empty()) {
    _mismatch[_model.receiver] = mismatch;
  }
  _sampler.put(character);
  for (line::Character seen; _sampler.next(character.endUs, seen);) {
    if (_received.size() == HardwareBuffer) {
      _lost++;
    } else {
      _received.push_back(seen);
      showReceived();
    }
  }
}

// RXC, and UPE of the oldest character: libsimavr has no parity, and its own times for received characters.
void AvrBoard::showReceived() {
  avr_uart_t &usart = *_usart;
  avr_regbit_setto(_avr, usart.upe, !_received.empty() && _received.front().bad);
  if (_received.empty()) {
    avr_regbit_clear(_avr, usart.rxc.raised);
    avr_clear_interrupt(_avr, &usart.rxc);
  } else {
    avr_raise_interrupt(_avr, &usart.rxc);
  }
}

uint8_t AvrBoard::dataRead(avr_t *, avr_io_addr_t, void *board) {
  std::deque<line::Character> &received = static_cast<AvrBoard *>(board)->_received;
  if (received.empty()) {
    return 0;
  }
  const uint8_t value = received.front().value;
  received.pop_front();
  static_cast<AvrBoard *>(board)->showReceived();
  return value;
}

// A character has been sent. UDR, if it holds another one, is empty then: UDREn, otherwise TXCn (ATmega2560 datasheet,
// 22.6.3).
avr_cycle_count_t AvrBoard::shifted(avr_t *avr, avr_cycle_count_t when, void *transmitter) {
  Transmitter &self = *static_cast<Transmitter *>(transmitter);
  avr_raise_interrupt(avr, self.hasNext ? &self.usart->udrc : &self.usart->txc);
  self.isSending = self.hasNext;
  self.hasNext = false;
  return self.isSending ? when + self.character : 0;
}

// A character is written to UDR. It begins to leave the TX pin at once, or after the one before.
void AvrBoard::send(size_t number, uint8_t byte) {
  const uint64_t us = clockUs(_avr->cycle);
  Transmitter &transmitter = _transmitters[number];
  if (transmitter.isSending) {
    transmitter.hasNext = true;
  } else {
    transmitter.isSending = true;
    avr_cycle_timer_register(_avr, transmitter.character, shifted, &transmitter);
    avr_raise_interrupt(_avr, &transmitter.usart->udrc);
  }
  const bool isRight = number == _model.console ? isSerial(settings(number)) : settings(number) == line::LineSettings();
  if (!isRight) {
    _mismatch[number] = "sends with " + text(settings(number));
  }
  if (number == _model.console) {
    return print(byte);
  }
  _sent.push_back({us, byte});
  if (number == _model.receiver) {
    line::Character character;
    _wireUs = std::max(us + 1, _wireUs) + line::CharacterUs;  // rounded up: then it really is complete
    character.endUs = _wireUs;
    character.value = byte;
    _wire.push_back(character);
    if (_line.isShared) {
      _line.source->hear(character);
    }
  }
}

void AvrBoard::print(uint8_t byte) {
  if (_row.text.empty()) {
    _row.us = clockUs(_avr->cycle);
  }
  if (byte == '\n') {
    _printed.push_back(_row);
    _row.text.clear();
  } else if (byte != '\r') {
    _row.text += static_cast<char>(byte);
  }
}

// Called whenever something is written to the port, be it to another pin.
void AvrBoard::edge(size_t pin, bool high) {
  if (high && _rose[pin] == 0) {
    _rose[pin] = _avr->cycle;
  } else if (!high && _rose[pin] != 0) {
    _pulses[pin].push_back({clockUs(_rose[pin]), static_cast<double>(_avr->cycle - _rose[pin]) / CyclesPerUs,
                            static_cast<double>(_rose[pin] - _clockZero) / CyclesPerUs});
    _rose[pin] = 0;
  }
}

}  // namespace avr
