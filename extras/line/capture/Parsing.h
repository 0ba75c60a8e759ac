// Parses words and numbers fast, without streams or locale.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "line/recording/Words.h"

namespace line {

constexpr bool isAscii(char c) { return static_cast<unsigned char>(c) < 0x80; }

// Returns the text without the blanks and quotation marks around it.
inline std::string_view trimmed(std::string_view text) { return withoutBlanks(text, '"'); }

// Takes a decimal number ("-1.25e-03") off the front. Returns false without one. `mark` may be the decimal point.
bool takeNumber(const char *&at, const char *end, double &value, char mark = '.');

// Reads a number. Returns false if `word` is not a number.
bool parseNumber(std::string_view word, double &value, char mark = '.');

// Returns the period of "1 MHz" or "1000000" in ns; 0 if it is not a rate.
double periodOf(std::string_view rate);

}  // namespace line
