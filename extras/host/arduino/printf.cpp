// printf() like the board's, where a long has 32 bits, like an int: %lu takes a uint32_t, and %ld prints -1 as -1. A
// sketch's calls of sprintf() and similar functions end here (../Makefile).

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <string>

#include "Print.h"

extern "C" {
int sketch_sprintf(char *text, const char *format, ...);
int sketch_snprintf(char *text, size_t size, const char *format, ...);
int sketch_vsprintf(char *text, const char *format, va_list arguments);
int sketch_vsnprintf(char *text, size_t size, const char *format, va_list arguments);
}

namespace {

// Returns the format with %lu replaced by %u, and so on; %llu stays. On a 64-bit PC every argument has 8 bytes; the
// lower 4 are read.
std::string with32Bits(const char *format) {
  std::string result;
  while (*format != '\0') {
    const bool conversion = *format == '%';
    result += *format++;
    if (conversion) {
      const size_t length = strspn(format, "-+ #0123456789.*");
      result.append(format, length);
      format += length;
      if (*format == 'l' && format[1] != 'l') {
        format++;
      } else if (*format != '\0') {
        result += *format++;
      }
    }
  }
  return result;
}

}  // namespace

int sketch_vsnprintf(char *text, size_t size, const char *format, va_list arguments) {
  return vsnprintf(text, size, with32Bits(format).c_str(), arguments);
}

int sketch_vsprintf(char *text, const char *format, va_list arguments) {
  return vsprintf(text, with32Bits(format).c_str(), arguments);
}

int sketch_snprintf(char *text, size_t size, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  const int length = sketch_vsnprintf(text, size, format, arguments);
  va_end(arguments);
  return length;
}

int sketch_sprintf(char *text, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  const int length = sketch_vsprintf(text, format, arguments);
  va_end(arguments);
  return length;
}

size_t Print::printf(const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  va_list again;
  va_copy(again, arguments);
  const int length = sketch_vsnprintf(nullptr, 0, format, arguments);
  std::string text(length > 0 ? static_cast<size_t>(length) + 1 : 0, '\0');
  sketch_vsnprintf(&text[0], text.size(), format, again);
  va_end(again);
  va_end(arguments);
  return text.empty() ? 0 : write(text.c_str(), text.size() - 1);
}
