// The name of a pin for the core's drivers. Here it is the pin's number.
#pragma once

#include <stdint.h>

struct PinDescription {
  uint16_t pin;
};

#define PINS_COUNT 26
extern const PinDescription g_APinDescription[PINS_COUNT];
