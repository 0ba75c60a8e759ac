// The functions of the C++ library that compiled code calls, for programs that have only its headers: there are no
// exceptions, so what would throw ends the program.
#include <stdlib.h>

#include <cstddef>
#include <new>
#include <string>

#include "Semihosting.h"

namespace {

[[noreturn]] void stop(const char *why) {
  semihosting(Semihosting::Write0, why);
  semihosting(Semihosting::Write0, "\n");
  exitWith(98);  // no other program ends so
}

}  // namespace

void *operator new(size_t size) {
  void *const memory = malloc(size > 0 ? size : 1);
  return memory != nullptr ? memory : (stop("no memory"), nullptr);
}

void operator delete(void *memory) noexcept { free(memory); }

void operator delete(void *memory, size_t) noexcept { free(memory); }

extern "C" {

void __cxa_pure_virtual() { stop("a pure virtual function was called"); }

// Statics are never destroyed: the machine ends with the program.
int __aeabi_atexit(void *, void (*)(void *), void *) { return 0; }

}  // extern "C"

// The headers declare that the library has it.
template class std::basic_string<char>;

// Defines what the library's <bits/functexcept.h> declares.
namespace std {

void __throw_bad_alloc() { stop("bad_alloc"); }
void __throw_bad_array_new_length() { stop("bad_array_new_length"); }
void __throw_bad_function_call() { stop("bad_function_call"); }
void __throw_length_error(const char *what) { stop(what); }
void __throw_logic_error(const char *what) { stop(what); }
void __throw_out_of_range_fmt(const char *format, ...) { stop(format); }

}  // namespace std
