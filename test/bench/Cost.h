// The cost of one call of a receiver, without the port's own instructions.
#pragma once

#include "BenchReceivers.h"

// Counts instructions, one by one. Under QEMU's -icount shift=10 each takes 1024 ns, and the M0's SysTick, at 16 MHz,
// counts 16.384 times meanwhile: so the count is exact. Without -icount it is nonsense, which calibrated() notices.
namespace instructions {

inline volatile uint32_t &sysTick(unsigned index) {
  return reinterpret_cast<volatile uint32_t *>(0xE000E010)[index];  // control, reload value, current value
}

inline void start() {
  sysTick(1) = 0xFFFFFF;
  sysTick(2) = 0;
  sysTick(0) = 5;  // counts down, at the processor's clock, without interrupt
}

// Returns how many instructions `work` takes with its call: from setting up the arguments to the return. A million at
// most.
template <typename Work>
__attribute__((noinline)) uint32_t of(const Work &work) {
  const uint32_t before = sysTick(2);
  __asm__ volatile("" ::: "memory");
  work();
  __asm__ volatile("" ::: "memory");
  const uint32_t ticks = (before - sysTick(2)) & 0xFFFFFF;
  return static_cast<uint32_t>((uint64_t{ticks} * 125 + 1024) / 2048) - 1;  // of the two readings, one lies in between
}

// Returns true if 300 instructions count as 300, and none as 0.
inline bool calibrated() {
  return of([] {}) == 0 && of([] { __asm__ volatile(".rept 300\n nop\n .endr"); }) == 300;
}

}  // namespace instructions

struct Cost {
  uint32_t instructions = 0;  // of the receiver
  uint32_t portCalls = 0;     // of the port's methods, which on a board cost more than here
  uint32_t frames = 0;

  Cost &operator+=(const Cost &other) {
    instructions += other.instructions;
    portCalls += other.portCalls;
    frames += other.frames;
    return *this;
  }
};

// Call it once, before anything is measured. Returns false if instructions cannot be counted: without -icount shift=10,
// or with a port that does not take a fixed number of instructions per call and byte.
bool calibrate();

// Returns the instructions of the port's methods themselves, without the calls.
uint32_t portsOwn(const MemorySerial::Calls &calls);

// Hands `count` bytes over, at fakeMicros, and measures the one call that takes them in, while `landing` more come.
template <typename Receiver>
Cost take(Receiver &receiver, const uint8_t *bytes, size_t count, size_t landing = 0) {
  Cost cost;
  const uint32_t before = receiver.frames();
  receiver.port.put(bytes, count);
  receiver.port.land(landing);
  cost.instructions = instructions::of([&] { receiver.parse(); });
  const MemorySerial::Calls &calls = receiver.port.calls;
  cost.instructions -= portsOwn(calls);
  cost.portCalls = calls.available + calls.singleReads + calls.reads;
  cost.frames = receiver.frames() - before;
  return cost;
}
