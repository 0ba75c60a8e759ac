// The pulses at the pins 2..5, where Servos has CH1..CH4.
#pragma once

#include "Expected.h"
#include "Mega.h"

namespace mega {

class Pulses {
 public:
  Pulses(Mega &mega, Expected &expected);
  Pulses(const Pulses &) = delete;  // libsimavr has been given its address
  Pulses &operator=(const Pulses &) = delete;

 private:
  struct Pin {
    Pulses *pulses;
    unsigned channel;
    bool high = false;
    avr_cycle_count_t rose = 0;
  };

  static void changed(avr_irq_t *, uint32_t value, void *pin);

  Mega &_mega;
  Expected &_expected;
  Pin _pins[4];
};

}  // namespace mega
