// Start-up code for a bare Cortex-M0 under QEMU: from reset to main(), and what a fault does.
#include <stdint.h>
#include <stdlib.h>

#include "Semihosting.h"

extern "C" {

// microbit.ld
extern uint32_t stackTop;
extern uint32_t dataStart, dataEnd, bssStart, bssEnd;
extern const uint32_t dataInFlash;

// newlib
void initialise_monitor_handles();
void __libc_init_array();

int program(int argc, char **argv) __asm__("main");  // C++ does not let a program call main() by its name
[[noreturn]] void start();
[[noreturn]] void fault();

// newlib calls these around the constructors and destructors, which here are all in arrays.
void _init() {
}
void _fini() {
}

// Names the only program to the code that registers destructors.
extern void *__dso_handle;
void *__dso_handle = nullptr;

}  // extern "C"

namespace {

constexpr int FaultStatus = 99;  // no doctest program ends so

// Splits the command line, which QEMU joins with spaces: no argument may hold a space.
int split(char *text, char **words, int most) {
  int count = 0;
  while (*text != '\0' && count < most) {
    words[count++] = text;
    while (*text != '\0' && *text != ' ') {
      text++;
    }
    if (*text == ' ') {
      *text++ = '\0';
    }
  }
  return count;
}

}  // namespace

void start() {
  const uint32_t *from = &dataInFlash;
  for (uint32_t *to = &dataStart; to < &dataEnd; to++) {
    *to = *from++;
  }
  for (uint32_t *to = &bssStart; to < &bssEnd; to++) {
    *to = 0;
  }
  initialise_monitor_handles();
  __libc_init_array();

  static char line[1024];
  static char *words[16];
  const struct {
    char *text;
    uint32_t size;
  } block = {line, sizeof line};
  const bool known = semihosting(Semihosting::GetCommandLine, &block) == 0;
  exit(program(known ? split(line, words, 15) : 0, words));
}

// A Cortex-M0 has this one fault for all causes: an unaligned access, an address without memory, an undefined
// instruction.
void fault() {
  semihosting(Semihosting::Write0, "HardFault\n");
  exitWith(FaultStatus);
}

namespace {

using Handler = void (*)();

// An M0 has 16 entries before the interrupts, of which none is enabled here.
struct Vectors {
  uint32_t *stack;
  Handler handlers[15];
};

__attribute__((section(".vectors"), used)) const Vectors vectors = {
    &stackTop,
    {start, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault}};

}  // namespace
