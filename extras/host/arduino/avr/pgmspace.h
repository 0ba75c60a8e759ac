// The host has one memory: data in "program memory" is read like any other.
#pragma once

#include <stdint.h>
#include <string.h>

#define PROGMEM
#define PSTR(text) (text)

#define pgm_read_byte(address) (*reinterpret_cast<const uint8_t *>(address))
#define pgm_read_word(address) (*reinterpret_cast<const uint16_t *>(address))
#define pgm_read_dword(address) (*reinterpret_cast<const uint32_t *>(address))
#define pgm_read_float(address) (*reinterpret_cast<const float *>(address))

#define memcpy_P memcpy
#define strcmp_P strcmp
#define strcpy_P strcpy
#define strlen_P strlen
