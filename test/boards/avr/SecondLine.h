// A second S.Bus line, at another USART than the one of the board's model.
#pragma once

#include <simavr/avr_uart.h>
#include <simavr/sim_avr.h>

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <vector>

#include "line/Line.h"
#include "line/LineSettings.h"
#include "line/uart/UartSampler.h"

namespace avr {

class SecondLine {
 public:
  // `settings` returns what the port's registers say, and `clockUs` the sketch's time.
  SecondLine(avr_t *avr, avr_uart_t &usart, std::unique_ptr<line::Line> source,
             std::function<line::LineSettings()> settings, std::function<uint64_t()> clockUs);
  SecondLine(const SecondLine &) = delete;  // libsimavr has been given its address
  SecondLine &operator=(const SecondLine &) = delete;

  // The sketch has written to UCSRnB, and with it switched the receiver on, or left it on, or not.
  void control(bool isOn);

  const std::vector<line::Character> &characters() const { return _characters; }  // on the line
  size_t lost() const { return _lost; }  // characters that were not read in time

 private:
  static avr_cycle_count_t poll(avr_t *avr, avr_cycle_count_t when, void *line);
  static uint8_t dataRead(avr_t *avr, avr_io_addr_t address, void *line);
  void show();

  static constexpr avr_cycle_count_t PollCycles = 160;  // 10 us
  static constexpr size_t HardwareBuffer = 3;           // characters that the USART holds

  avr_t *const _avr;
  avr_uart_t &_usart;
  const std::unique_ptr<line::Line> _source;
  const std::function<line::LineSettings()> _settings;
  const std::function<uint64_t()> _clockUs;
  line::UartSampler _sampler;
  std::deque<line::Character> _received;  // and not yet read
  std::vector<line::Character> _characters;
  bool _isOpen = false;
  line::LineSettings _opened;  // with these
  size_t _lost = 0;
};

}  // namespace avr
