// The vectors of a bare Cortex-M0 under QEMU. Newlib's start-up code, rdimon's, does the rest: it asks QEMU for the
// stack, the heap and the arguments, and calls main().
#include <stdint.h>

#include "Semihosting.h"

extern "C" void _start();

namespace {

constexpr int FaultStatus = 99;            // no doctest program ends so
constexpr uint32_t StackTop = 0x24000000;  // of the RAM that qemu.sh gives

// A Cortex-M0 has this one fault for all causes: an unaligned access, an address without memory, an undefined
// instruction.
[[noreturn]] void fault() {
  semihosting(Semihosting::Write0, "HardFault\n");
  exitWith(FaultStatus);
}

using Handler = void (*)();

// An M0 has 16 entries before the interrupts, of which none is enabled here.
struct Vectors {
  uint32_t stack;
  Handler handlers[15];
};

}  // namespace

extern "C" const Vectors vectors;
__attribute__((section(".vectors"))) const Vectors vectors = {
    StackTop,
    {_start, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault}};
