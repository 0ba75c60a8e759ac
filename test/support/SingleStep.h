// Interrupts code after any one of its instructions, on an x86-64 Linux: the trap flag makes the processor stop after
// each instruction, and the n-th stop is the interrupt. SINGLE_STEP is defined where this works. For one source file.
#pragma once

#if defined(__x86_64__) && defined(__linux__)
#define SINGLE_STEP

#include <doctest/doctest.h>
#include <signal.h>
#include <ucontext.h>

namespace {

constexpr greg_t TrapFlag = 0x100;

void (*interrupt)();             // what interrupts the code
unsigned long instructionsLeft;  // until the interrupt; 0: it has come

void onTrap(int, siginfo_t *, void *context) {
  if (instructionsLeft == 0 || --instructionsLeft > 0) {
    return;
  }
  interrupt();
  static_cast<ucontext_t *>(context)->uc_mcontext.gregs[REG_EFL] &= ~TrapFlag;  // the rest runs at full speed
}

void listen() {
  struct sigaction action = {};
  action.sa_sigaction = onTrap;
  action.sa_flags = SA_SIGINFO;
  REQUIRE(sigaction(SIGTRAP, &action, nullptr) == 0);
}

// Runs `reader`, interrupted after its instruction number `instruction` (from 1). Returns false if it has fewer.
template <typename Reader>
__attribute__((noinline)) bool interrupted(unsigned long instruction, const Reader &reader) {
  instructionsLeft = instruction;
  // 128 bytes below the stack pointer may be in use: the red zone.
  asm volatile("sub $128, %%rsp\n pushfq\n orq $0x100, (%%rsp)\n popfq\n add $128, %%rsp" ::: "memory", "cc");
  reader();
  asm volatile("sub $128, %%rsp\n pushfq\n andq $~0x100, (%%rsp)\n popfq\n add $128, %%rsp" ::: "memory", "cc");
  const bool happened = instructionsLeft == 0;
  instructionsLeft = 0;
  return happened;
}

// Calls `run(instruction)`, which calls interrupted(), with 1, 2, 3 ... until it returns false: the code has no more.
template <typename Run>
void forEveryInstruction(const Run &run) {
  listen();
  unsigned long instruction = 0;
  bool happened = true;
  while (happened) {
    instruction++;
    CAPTURE(instruction);
    happened = run(instruction);
  }
}

}  // namespace

#endif
