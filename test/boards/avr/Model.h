// The boards that are simulated: their chips, all at 16 MHz, and where their cores have what the tests look at.
#pragma once

#include <cstddef>

namespace avr {

struct Pin {
  char port;
  int bit;
};

struct Model {
  const char *name;  // of the folder with its sketches
  const char *chip;
  size_t receiver;  // the USART at the S.Bus line
  size_t console;   // the USART that prints; None: the USB does, or nothing
  Pin servos[4];    // the pins 2..5
  Pin led;
  Pin inputs[4];  // of PwmIn
  size_t eepromBytes;
};

constexpr size_t None = 4;  // a chip has at most four

constexpr Model Mega = {"mega",
                        "atmega2560",
                        1,
                        0,
                        {{'E', 4}, {'E', 5}, {'G', 5}, {'E', 3}},
                        {'B', 7},
                        {{'E', 4}, {'E', 5}, {'D', 1}, {'D', 0}},
                        4096};
constexpr Model Uno = {"uno", "atmega328p", 0, None, {{'D', 2}, {'D', 3}, {'D', 4}, {'D', 5}}, {'B', 5}, {}, 1024};
constexpr Model Leonardo = {"leonardo", "atmega32u4", 1,   None, {{'D', 1}, {'D', 0}, {'D', 4}, {'C', 6}},
                            {'C', 7},   {},           1024};

}  // namespace avr
