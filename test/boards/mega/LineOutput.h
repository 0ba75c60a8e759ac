// What leaves the TX pin of a USART. Behind the pin there is an inverter.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>

#include "Mega.h"
#include "line/LineSettings.h"

namespace mega {

class LineOutput {
 public:
  LineOutput(Mega &mega, int number);       // of the USART, 0..3
  LineOutput(const LineOutput &) = delete;  // libsimavr has been given its address
  LineOutput &operator=(const LineOutput &) = delete;

  // Called when the sketch has set the port to something else than before.
  void onSettings(std::function<void(const line::LineSettings &)> callback) { _onSettings = std::move(callback); }

  // Called when a character begins, with the cycle in which it will be through.
  void onCharacter(std::function<void(uint8_t, avr_cycle_count_t)> callback) { _onCharacter = std::move(callback); }

 private:
  static void controlWritten(avr_irq_t *, uint32_t value, void *output);
  static void sent(avr_irq_t *, uint32_t value, void *output);

  Mega &_mega;
  const int _number;
  line::LineSettings _settings;
  avr_cycle_count_t _characterCycles = 0;
  avr_cycle_count_t _end = 0;  // of the last character
  std::function<void(const line::LineSettings &)> _onSettings;
  std::function<void(uint8_t, avr_cycle_count_t)> _onCharacter;
};

}  // namespace mega
