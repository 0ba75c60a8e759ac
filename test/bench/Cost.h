// What one call of a receiver takes, without the port's own instructions.
#pragma once

#include "Instructions.h"
#include "Receivers.h"

struct Cost {
  uint32_t instructions = 0;  // of the receiver
  uint32_t portCalls = 0;     // of the port's methods, which on a board cost more than here
  uint32_t frames = 0;

  void add(const Cost &other) {
    instructions += other.instructions;
    portCalls += other.portCalls;
    frames += other.frames;
  }
};

// To be called once, before anything is measured. False if there is no counting here: not an -icount of 10, or a port
// that takes other than a fixed number of instructions per call and byte.
bool calibrate();

// What the port takes to be asked for room, and for a frame: the instructions of its methods, without the calls.
uint32_t costOfPortsOwn(MemorySerial &port);

// Hands `count` bytes over, at fakeMicros, and measures the one call that takes them in.
Cost take(Ours &ours, const uint8_t *bytes, size_t count);
Cost take(Papers &papers, const uint8_t *bytes, size_t count);
