// Binary numbers of up to eight digits: B0 .. B11111111. The cores have macros (cores/arduino/binary.h); these are
// enumerators.
#pragma once

// A number, and all those that begin with its digits.
#define HOST_BITS_1(name, value) name = value
#define HOST_BITS_2(name, value) \
  HOST_BITS_1(name, value), HOST_BITS_1(name##0, 2 * (value)), HOST_BITS_1(name##1, 2 * (value) + 1)
#define HOST_BITS_3(name, value) \
  HOST_BITS_1(name, value), HOST_BITS_2(name##0, 2 * (value)), HOST_BITS_2(name##1, 2 * (value) + 1)
#define HOST_BITS_4(name, value) \
  HOST_BITS_1(name, value), HOST_BITS_3(name##0, 2 * (value)), HOST_BITS_3(name##1, 2 * (value) + 1)
#define HOST_BITS_5(name, value) \
  HOST_BITS_1(name, value), HOST_BITS_4(name##0, 2 * (value)), HOST_BITS_4(name##1, 2 * (value) + 1)
#define HOST_BITS_6(name, value) \
  HOST_BITS_1(name, value), HOST_BITS_5(name##0, 2 * (value)), HOST_BITS_5(name##1, 2 * (value) + 1)
#define HOST_BITS_7(name, value) \
  HOST_BITS_1(name, value), HOST_BITS_6(name##0, 2 * (value)), HOST_BITS_6(name##1, 2 * (value) + 1)
#define HOST_BITS_8(name, value) \
  HOST_BITS_1(name, value), HOST_BITS_7(name##0, 2 * (value)), HOST_BITS_7(name##1, 2 * (value) + 1)
enum { HOST_BITS_8(B0, 0), HOST_BITS_8(B1, 1) };
