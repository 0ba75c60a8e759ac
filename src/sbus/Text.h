/// @file
/// Text for people, which an AVR keeps in flash.
#pragma once

#include <stddef.h>

#if defined(__AVR__)
#include <avr/pgmspace.h>
class __FlashStringHelper;  // Arduino's
#endif

namespace sbus {

/// The type that Serial.print(), println() and String take: a string, on an AVR one in flash, like F()'s. There
/// snprintf() needs %S for it: with %s, which the compiler accepts, it prints garbage.
#if defined(__AVR__)
using Text = const __FlashStringHelper *;
#define SBUS_FLASH PROGMEM
#define SBUS_IN_FLASH(place) pgm_read_byte(place)
#else
using Text = const char *;
#define SBUS_FLASH                       ///< keeps an array of characters in flash
#define SBUS_IN_FLASH(place) (*(place))  ///< reads one of them
#endif

/// Returns text `number` of `texts`, an array in flash, in which "\0" ends each; "" if there are fewer.
template <size_t Size>
Text textOf(const char (&texts)[Size], unsigned number) {
  const char *text = texts;
  for (; number > 0 && text < texts + Size - 1; text++) {
    number -= SBUS_IN_FLASH(text) == 0;
  }
  return reinterpret_cast<Text>(text);
}

}  // namespace sbus
