/// @file
/// Text for people, which an AVR keeps in flash.
#pragma once

#if defined(__AVR__)
#include <avr/pgmspace.h>
class __FlashStringHelper;  // Arduino's
#endif

namespace sbus {

/// The type that Serial.print(), println() and String take: a string, on an AVR one in flash, like F()'s. There
/// snprintf() needs %S for it: with %s, which the compiler accepts, it prints garbage.
#if defined(__AVR__)
using Text = const __FlashStringHelper *;
#define SBUS_TEXT(words) reinterpret_cast<Text>(PSTR(words))
#else
using Text = const char *;
#define SBUS_TEXT(words) words  ///< makes a Text from a literal, within a function
#endif

}  // namespace sbus
