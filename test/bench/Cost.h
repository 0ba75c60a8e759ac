// The cost of one call of a receiver, without the port's own instructions.
#pragma once

#include "Instructions.h"
#include "BenchReceivers.h"

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

// Return the instructions of the port's methods themselves, without the calls.
uint32_t portsOwn(const MemorySerial::Calls &calls);
uint32_t portsOwnOfSending();  // asked for room, and given a frame

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
