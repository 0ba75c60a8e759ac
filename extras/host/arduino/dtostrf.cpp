#include "avr/dtostrf.h"

#include <stdio.h>

char *dtostrf(double value, signed char width, unsigned char precision, char *text) {
  sprintf(text, "%*.*f", width, precision, value);
  return text;
}
