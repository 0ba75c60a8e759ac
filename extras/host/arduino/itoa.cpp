#include "itoa.h"

#include <stdint.h>
#include <stdio.h>

#include "avr/dtostrf.h"

char *ultoa(unsigned long number, char *text, int base) {
  if (text == nullptr || base < 2 || base > 36) {
    return nullptr;
  }
  const uint32_t radix = static_cast<uint32_t>(base);
  char digits[32];
  int count = 0;
  uint32_t rest = static_cast<uint32_t>(number);
  do {
    digits[count++] = "0123456789abcdefghijklmnopqrstuvwxyz"[rest % radix];
    rest /= radix;
  } while (rest != 0);
  char *end = text;
  while (count > 0) {
    *end++ = digits[--count];
  }
  *end = '\0';
  return text;
}

char *ltoa(long number, char *text, int base) {
  const int32_t signedNumber = static_cast<int32_t>(number);
  if (text == nullptr || base != 10 || signedNumber >= 0) {
    return ultoa(static_cast<uint32_t>(signedNumber), text, base);
  }
  text[0] = '-';
  ultoa(0u - static_cast<uint32_t>(signedNumber), text + 1, base);
  return text;
}

char *itoa(int number, char *text, int base) { return ltoa(number, text, base); }

char *utoa(unsigned number, char *text, int base) { return ultoa(number, text, base); }

char *dtostrf(double value, signed char width, unsigned char precision, char *text) {
  sprintf(text, "%*.*f", width, precision, value);
  return text;
}
