#include "Print.h"

#include <math.h>

size_t Print::write(const uint8_t *buffer, size_t size) {
  size_t written = 0;
  while (written < size && write(buffer[written]) != 0) {
    written++;
  }
  return written;
}

// Only base ten has a minus: in other bases a negative number shows its 32 bits.
size_t Print::printSigned(int32_t number, int base) {
  if (number >= 0 || base != DEC) {
    return printUnsigned(static_cast<uint32_t>(number), base);
  }
  const size_t sign = print('-');
  return sign + printUnsigned(0u - static_cast<uint32_t>(number), DEC);
}

size_t Print::printUnsigned(uint32_t number, int base) {
  if (base == 0) {
    return write(static_cast<uint8_t>(number));  // base 0 is the raw byte
  }
  const uint32_t radix = base == 1 ? DEC : static_cast<uint8_t>(base);
  char text[32];  // enough for base 2
  char *begin = text + sizeof text;
  do {
    const uint32_t digit = number % radix;
    *--begin = static_cast<char>(digit < 10 ? '0' + digit : 'A' + (digit - 10));
    number /= radix;
  } while (number != 0);
  return write(begin, static_cast<size_t>(text + sizeof text - begin));
}

// Rounds by adding half of the last digit, then takes digit by digit: unlike printf(), but like the board.
size_t Print::print(double number, int digits) {
  constexpr double Largest = 4294967040.0;  // beyond it the board prints "ovf"
  if (isnan(number)) {
    return print("nan");
  }
  if (isinf(number)) {
    return print("inf");
  }
  if (number > Largest || number < -Largest) {
    return print("ovf");
  }

  size_t printed = 0;
  if (number < 0) {
    printed += print('-');
    number = -number;
  }

  const uint8_t decimals = static_cast<uint8_t>(digits);
  double half = 0.5;
  for (uint8_t i = 0; i < decimals; i++) {
    half /= 10;
  }
  number += half;

  const uint32_t whole = static_cast<uint32_t>(number);
  printed += print(whole);
  if (decimals > 0) {
    printed += print('.');
  }
  double rest = number - whole;
  for (uint8_t i = 0; i < decimals; i++) {
    rest *= 10;
    const unsigned digit = static_cast<unsigned>(rest);
    printed += print(digit);
    rest -= digit;
  }
  return printed;
}
