// The pulses at the pins 2..5, written down: "pin,begin,width" for each when it ends, in microseconds; times are the
// line's.
#pragma once

#include <cstdio>
#include <string>

#include "LineInput.h"
#include "Mega.h"

namespace mega {

class Pulses {
 public:
  Pulses(Mega &mega, const LineInput &line, const std::string &file);  // throws std::runtime_error
  ~Pulses();
  Pulses(const Pulses &) = delete;  // libsimavr has been given its address
  Pulses &operator=(const Pulses &) = delete;

  // The sketch begins to print a line: "line,when", in between.
  void lineBegins();

  // False if the file could not be written to its end.
  bool finish() { return std::fflush(_file) == 0; }

 private:
  struct Pin {
    Pulses *pulses;
    int number;
    bool high = false;
    avr_cycle_count_t rose = 0;
  };

  static void changed(avr_irq_t *, uint32_t value, void *pin);
  double toUs(avr_cycle_count_t cycle) const;

  Mega &_mega;
  const LineInput &_line;
  Pin _pins[4];
  std::FILE *const _file;
};

}  // namespace mega
