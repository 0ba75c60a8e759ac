// What one call of a receiver takes, without the port's own instructions.
#pragma once

#include "Instructions.h"
#include "Receivers.h"

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

// To be called once, before anything is measured. False if there is no counting here: not an -icount of 10, or a port
// that takes other than a fixed number of instructions per call and byte.
bool calibrate();

// Instructions of the port's methods themselves, without the calls.
uint32_t portsOwn(const MemorySerial::Calls &calls);
uint32_t portsOwnOfSending();  // asked for room, and given a frame

// Hands `count` bytes over, at fakeMicros, and measures the one call that takes them in.
template <typename Receiver>
Cost take(Receiver &receiver, const uint8_t *bytes, size_t count) {
  Cost cost;
  const uint32_t before = receiver.frames();
  receiver.port.put(bytes, count);
  cost.instructions = instructions::of([&] { receiver.parse(); });
  const MemorySerial::Calls &calls = receiver.port.calls;
  cost.instructions -= portsOwn(calls);
  cost.portCalls = calls.available + calls.singleReads + calls.reads;
  cost.frames = receiver.frames() - before;
  return cost;
}
