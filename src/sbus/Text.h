/// @file
/// Words for a person, which an AVR keeps in flash.
#pragma once

#if defined(__AVR__)
#include <avr/pgmspace.h>
class __FlashStringHelper;  // Arduino's
#endif

namespace sbus {

/// What Serial.print(), println() and String take: a string; on an AVR one in flash, as F() gives it. There snprintf()
/// needs %S for it: with %s, which the compiler accepts, it prints something else.
#if defined(__AVR__)
using Text = const __FlashStringHelper *;
#define SBUS_TEXT(words) reinterpret_cast<Text>(PSTR(words))
#else
using Text = const char *;
#define SBUS_TEXT(words) words  ///< makes one of a literal, within a function
#endif

}  // namespace sbus
