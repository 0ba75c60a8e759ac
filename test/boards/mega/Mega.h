// An Arduino Mega: an ATmega2560 at 16 MHz, simulated by libsimavr, that runs the sketch of an .elf file.
#pragma once

#include <simavr/avr_uart.h>
#include <simavr/sim_avr.h>

#include <cstdint>
#include <string>

#include "line/LineSettings.h"

namespace mega {

constexpr uint32_t CyclesPerUs = 16;

class Mega {
 public:
  // Throws std::runtime_error if the file cannot be loaded.
  explicit Mega(const std::string &elf);
  ~Mega();
  Mega(const Mega &) = delete;  // libsimavr has been given its address
  Mega &operator=(const Mega &) = delete;

  // Runs the sketch for about a character's time. Throws if it crashes.
  void run();

  // What the sketch's micros() counts from: timer 0 was set going in this cycle, some before setup().
  avr_cycle_count_t clockZero() const { return _clockZero; }
  uint64_t clockUs() const { return (_avr->cycle - _clockZero) / CyclesPerUs; }

  avr_t *avr() { return _avr; }
  avr_uart_t &usart(int number) { return *_usarts[number]; }  // 0..3

  // What the sketch has set a port to, as its registers have it.
  line::LineSettings settings(int number) const;

 private:
  static constexpr int UsartCount = 4;

  static void timerStarted(avr_irq_t *, uint32_t value, void *mega);

  void load(const std::string &elf);
  void findUsarts();

  avr_t *_avr;
  avr_uart_t *_usarts[UsartCount] = {};
  avr_cycle_count_t _clockZero = 0;
};

}  // namespace mega
