#include "Uart.h"

#include <algorithm>

#include "World.h"

namespace sim {

World world;

void World::pass(uint64_t us) {
  uint64_t left = us;
  for (;;) {
    const uint64_t others = othersUs + randomUs != 0 && masked == 0 ? std::max(othersAtUs, nowUs) : Never;
    const bool calls = masked == 0 && (locked == 0 || !alarmWaits) && !inAlarm && alarmAtUs != Never;
    const uint64_t own = calls ? std::max(alarmAtUs, nowUs) : Never;
    const uint64_t complete = masked == 0 && completeAtUs != Never ? std::max(completeAtUs, nowUs) : Never;
    const uint64_t first = std::min({others, own, complete});
    if (first == Never || first - nowUs > left) {
      nowUs += left;
      return;
    }
    left -= first - nowUs;
    nowUs = first;
    if (complete == first) {
      completeAtUs = nowUs;
      release();
    } else if (others <= own) {
      nowUs += othersUs + upTo(upTo(randomUs));
      othersAtUs = nowUs - othersUs + (randomUs != 0 ? upTo(2 * 997 + 4 * randomUs) : 997);
    } else {
      alarmAtUs = Never;
      inAlarm = true;
      alarm();
      inAlarm = false;
    }
  }
}

void World::release() {
  if (masked == 0 && completeAtUs <= nowUs) {
    driven.back().untilUs = completeAtUs;
    completeAtUs = Never;
  }
}

const Driven *World::drivenWithin(uint64_t beginUs, uint64_t endUs) const {
  for (auto each = driven.rbegin(); each != driven.rend() && each->untilUs > beginUs; ++each) {
    if (each->fromUs < endUs) {
      return &*each;
    }
  }
  return nullptr;
}

void inPort() { world.pass(world.portUs); }

void print(char c) { world.printed += c; }

Uart::Uart(const Facts &facts, Drops drops, bool wired)
    : _facts(facts), _drops(drops), _wired(wired), _size(facts.buffer), _burst(facts.burst) {}

void Uart::crash() const { world.crashes++; }

void Uart::fault(unsigned what) const {
  if (!_open && (_facts.faults & what) != 0) {
    crash();
  }
}

void Uart::open(const Settings &settings, bool isHalfDuplex) {
  if (settings.baud == 0) {
    _open = false;
    fault(NoBaud);
  }
  _open = true;
  _openedUs = _lastUs = world.nowUs;
  _first = _count = _filled = _stashed = _position = _taken = 0;
  _takesUs = _countsUs = Never;
  _settings = settings;
  _settings.baud = std::max(settings.baud, 1ul);
  world.completeAtUs = World::Never;
  _isHalfDuplex = isHalfDuplex;
  drive(!isHalfDuplex);
}

void Uart::drive(bool drives) const {
  const bool isDriving = !world.driven.empty() && world.driven.back().untilUs == World::Never;
  if (drives && !isDriving) {
    world.driven.push_back({world.nowUs, World::Never});
  } else if (!drives && isDriving) {
    world.driven.back().untilUs = world.nowUs;
  }
}

void Uart::change(const Settings &settings) {
  if (_open) {
    receive();
    _settings = settings;
  } else {
    open(settings);
  }
}

void Uart::close() {
  fault(End);
  if (_open) {
    flush();
    drive(false);
  }
  _open = false;
}

void Uart::cut() {
  fault(End);
  for (; pending() != 0; world.sent.pop_back()) {
  }
  _freeNs = 0;
  _open = false;
}

// Within 2 %: beyond, the second stop bit is out of place.
bool Uart::hears() const {
  const double ratio = static_cast<double>(_settings.baud) / static_cast<double>(world.baud);
  return _settings.evenStops != 0 && ratio > 0.98 && ratio < 1.02 && _settings.rxInverted == world.inverted &&
         (_isHalfDuplex ? CoreTxPin : _pin) == world.pin;
}

// A half duplex port is deaf while it drives the wire. If it lets go in the middle of a character, it takes what is
// left of that for another one.
bool Uart::isDeaf(uint64_t beginUs, uint64_t endUs, uint8_t &value) const {
  const Driven *const driven = _isHalfDuplex && !world.echoes ? world.drivenWithin(beginUs, endUs) : nullptr;
  if (driven == nullptr) {
    return false;
  }
  value = static_cast<uint8_t>(value >> 1 | 0x80);
  return driven->untilUs >= endUs;
}

void Uart::handOver() {
  if (_drops == Fifo && _count + (_stashed != 0 ? _stashed : _filled) > _size) {
    _stashed = _stashed != 0 ? _stashed : _filled;
    if (_filled - _stashed >= FifoSize) {
      world.dropped += _filled - _stashed;
      _filled = _stashed;
    }
    return;
  }
  for (unsigned i = 0; i < _filled; i++) {
    if (_count == _size) {
      if (_drops == Fifo) {
        std::copy(_fifo + i, _fifo + _filled, _fifo);
        _filled = _stashed = _filled - i;
        return;
      }
      world.dropped++;
      if (_drops == Newest) {
        continue;
      }
      _first = (_first + 1) % Largest;
      _count--;
    }
    _buffer[(_first + _count++) % Largest] = _fifo[i];
  }
  _filled = _stashed = 0;
}

// An interrupt of the driver is raised. (What follows if the buffer is full, only the prompt driver has.)
void Uart::raise(uint64_t us) {
  if (world.driverLateUs == 0) {
    handOver();
  } else if (_filled != _taken && _takesUs == Never) {
    _takesUs = us + world.upTo(world.driverLateUs);
  }
}

// All that a late driver does until then: it takes all that is in the FIFO (esp-idf 01b912a, driver/uart/uart.c,
// uart_rx_intr_handler_default()), and adds to rx_buffered_len at the end.
void Uart::interrupts(uint64_t us) {
  while (std::min(_takesUs, _countsUs) <= us) {
    if (_countsUs == Never) {
      _taken = _filled;
      _countsUs = _takesUs + world.upTo(world.driverUs);
      _takesUs = Never;
      continue;
    }
    if (_countsUs > us) {
      return;
    }
    for (unsigned i = 0; i < _taken; i++) {
      _buffer[(_first + _count++) % Largest] = _fifo[i];
    }
    std::copy(_fifo + _taken, _fifo + _filled, _fifo);
    _filled -= _taken;
    _taken = 0;
    _takesUs = _takesUs != Never ? std::max(_takesUs, _countsUs) : Never;
    _countsUs = Never;
  }
}

unsigned Uart::fifo() {
  receive();
  return _filled - _taken;
}

void Uart::turnOff(uint64_t us) {
  receive();
  world.offFromUs = world.nowUs;
  world.nowUs += us;
  world.offUntilUs = world.nowUs;
  if (_overflowUs != 0) {
    const uint64_t overflows = world.offUntilUs / _overflowUs - world.offFromUs / _overflowUs;
    world.stoodStillUs += overflows > 1 ? (overflows - 1) * _overflowUs : 0;
  }
}

void Uart::receive() {
  if (!_wired || !_open) {
    return;
  }
  if (world.wire != nullptr) {
    world.wire->until(world.nowUs);
  }
  world.release();
  const uint64_t characterUs = 12 * 1000000 / world.baud;
  const auto idleUntil = [&](uint64_t us) {
    if (us >= _lastUs + _facts.idle * characterUs) {
      raise(_lastUs + _facts.idle * characterUs);
    }
    interrupts(us);
  };
  unsigned kept = 0;  // while interrupts were off
  const auto take = [&](uint64_t beginUs, uint64_t endUs, uint8_t value, bool heard) {
    world.next++;
    if (beginUs < _openedUs || !heard || isDeaf(beginUs, endUs, value)) {
      return;
    }
    if (endUs > world.offFromUs && endUs <= world.offUntilUs && kept++ >= _keeps) {
      return;
    }
    idleUntil(beginUs);
    interrupts(endUs - world.earlyUs);
    _lastUs = endUs;
    if (_filled - _taken == FifoSize && _drops == Fifo && world.driverLateUs != 0) {
      world.dropped += FifoSize;  // the driver resets it
      _filled = _taken;
    }
    _fifo[_filled++] = value;
    _position++;
    if (_facts.ring ? _position % _burst == 0 : _filled - _taken >= _burst) {
      raise(endUs);
    }
  };
  if (world.looped) {
    while (world.next < world.sent.size() && world.sent[world.next].endUs <= world.nowUs) {
      const Sent &sent = world.sent[world.next];
      const bool same = sent.settings.txInverted == _settings.rxInverted && _pin == world.pin;
      take(sent.beginUs, sent.endUs, sent.value, _settings.evenStops != 0 && same);
    }
  } else {
    while (world.next < world.line.size() && world.line[world.next].endUs <= world.nowUs + world.earlyUs) {
      const auto &character = world.line[world.next];
      const bool discarded = character.bad && discards(world.error);
      take(character.endUs - characterUs, character.endUs, character.value, hears() && !discarded);
    }
  }
  idleUntil(world.nowUs);
}

int Uart::available() {
  fault(Available);
  world.crashes += world.inUart;
  receive();
  return _open ? static_cast<int>(_count + (_seesFifo ? _filled : 0)) : 0;
}

int Uart::read() {
  uint8_t byte;
  return read(&byte, 1) == 1 ? byte : -1;
}

int Uart::read(uint8_t *buffer, size_t size) {
  if (world.reader != nullptr) {
    world.reader->beforeRead();
  }
  world.nowUs += world.lateUs;
  world.lateUs = 0;
  const size_t count = std::min(size, static_cast<size_t>(available()));
  for (size_t i = 0; i < count; i++) {
    if (_count == 0) {
      buffer[i] = _fifo[0];
      std::copy(_fifo + 1, _fifo + _filled--, _fifo);
      continue;
    }
    buffer[i] = _buffer[_first];
    _first = (_first + 1) % Largest;
    _count--;
  }
  if (_stashed != 0) {
    handOver();
  }
  return static_cast<int>(count);
}

unsigned Uart::pending() const {
  const auto waits = [](const Sent &sent) { return sent.endUs > world.nowUs; };
  return static_cast<unsigned>(std::find_if_not(world.sent.rbegin(), world.sent.rend(), waits) - world.sent.rbegin());
}

int Uart::room() {
  fault(Room);
  return _open ? static_cast<int>(_facts.transmitter - pending()) : 0;
}

size_t Uart::write(uint8_t byte) {
  fault(Write);
  if (!_open) {
    return 0;
  }
  if (!_wired) {
    print(static_cast<char>(byte));
    return 1;
  }
  drive(true);
  if (_facts.transmitter != 0 && pending() >= _facts.transmitter) {
    world.nowUs = world.sent[world.sent.size() - _facts.transmitter].endUs;
  }
  const uint64_t characterNs = (1 + 8 + 1 + _settings.evenStops) * 1000000000ull / _settings.baud;
  const uint64_t beginNs = std::max(world.nowUs * 1000, _freeNs);
  _freeNs = beginNs + characterNs;
  world.sent.push_back({beginNs / 1000, (_freeNs + 999) / 1000, byte, _settings});
  if (_isHalfDuplex) {
    world.completeAtUs = world.sent.back().endUs;
  }
  if (world.wire != nullptr) {
    world.wire->sent(world.sent.back());
  }
  if (_facts.transmitter == 0) {
    flush();
  }
  return 1;
}

void Uart::flush() {
  if (pending() != 0) {
    world.nowUs = world.sent.back().endUs;
    world.release();
  }
}

}  // namespace sim

// Time, for sketch and library.
uint32_t micros();
uint32_t cycleCount();
uint32_t millis();
void delay(unsigned long ms);
void delayMicroseconds(unsigned us);
void yield();
void digitalWrite(uint32_t pin, uint32_t level);

uint32_t micros() {
  sim::world.pass(sim::world.tickUs);
  const uint64_t us = sim::world.nowUs - sim::world.stoodStillUs, hz = sim::world.clockHz;
  return static_cast<uint32_t>(hz == 0 ? us : us * hz / 1000000 * 1000000 / hz);
}
// Of 600 MHz.
uint32_t cycleCount() { return static_cast<uint32_t>(sim::world.nowUs * 600); }
uint32_t millis() {
  sim::world.pass(sim::world.tickUs);
  return static_cast<uint32_t>((sim::world.nowUs - sim::world.stoodStillUs) / 1000);
}
void delay(unsigned long ms) { sim::world.pass(ms * 1000); }
void delayMicroseconds(unsigned us) { sim::world.pass(us); }
void yield() {}
void digitalWrite(uint32_t, uint32_t level) { sim::world.levels.push_back({sim::world.nowUs, level != 0}); }
