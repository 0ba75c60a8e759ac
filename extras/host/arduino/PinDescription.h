// How the core's drivers call a pin of the board. Here a pin is called by its number.
#pragma once

#include <stdint.h>

struct PinDescription {
  uint16_t pin;
};

#define PINS_COUNT 26
extern const PinDescription g_APinDescription[PINS_COUNT];
