#include "Cost.h"

#include <initializer_list>

namespace {

// Instructions of the port's methods themselves, without the call.
struct PortCost {
  uint32_t available;
  uint32_t singleRead;
  uint32_t read;
  uint32_t byte;

  uint32_t of(const MemorySerial::Calls &calls) const {
    return available * calls.available + singleRead * calls.singleReads + read * calls.reads + byte * calls.bytes;
  }
};

PortCost portCost;

__attribute__((noinline)) int nothing(MemorySerial &port, uint8_t *buffer, size_t size) {
  __asm__ volatile("" : : "r"(&port), "r"(buffer), "r"(size));
  return 0;
}

uint8_t buffer[64];

// Of read(buffer, size), while `waiting` bytes wait.
uint32_t costOfRead(MemorySerial &port, size_t size, size_t waiting) {
  static const uint8_t bytes[64] = {};
  const uint32_t call = instructions::of([&] { nothing(port, buffer, size); }) - 1;  // it consists of its return
  port.put(bytes, waiting);
  return instructions::of([&] { port.read(buffer, size); }) - call;
}

template <typename Both>
Cost takeIn(Both &both, const uint8_t *bytes, size_t count) {
  both.port.put(bytes, count);
  const uint32_t all = instructions::of([&] { parse(both); });
  const MemorySerial::Calls &calls = both.port.calls;
  Cost cost;
  cost.instructions = all - portCost.of(calls);
  cost.portCalls = calls.available + calls.singleReads + calls.reads;
  return cost;
}

}  // namespace

bool calibrate() {
  instructions::start();
  if (!instructions::calibrated()) {
    return false;
  }
  MemorySerial port;
  const uint32_t call = instructions::of([&] { nothing(port, buffer, 0); }) - 1;
  port.put(buffer, 64);
  portCost.available = instructions::of([&] { port.available(); }) - call;
  portCost.singleRead = instructions::of([&] { port.read(); }) - call;
  portCost.read = costOfRead(port, 0, 64);
  portCost.byte = costOfRead(port, 1, 64) - portCost.read;
  for (const size_t size : {1u, 2u, 16u, 29u, 64u}) {
    for (const size_t waiting : {1u, 2u, 16u, 64u}) {
      const size_t count = size < waiting ? size : waiting;
      const uint32_t expected = portCost.read + portCost.byte * count;
      const uint32_t found = costOfRead(port, size, waiting);
      if (found > expected + 1 || expected > found + 1) {
        return false;
      }
    }
  }
  return true;
}

uint32_t costOfPortsOwn(MemorySerial &port) {
  const uint32_t call = instructions::of([&] { nothing(port, buffer, 25); }) - 1;
  const uint32_t room = instructions::of([&] { port.availableForWrite(); }) - call;
  return room + instructions::of([&] { port.write(buffer, 25); }) - call;
}

Cost take(Ours &ours, const uint8_t *bytes, size_t count) {
  const uint32_t before = ours.receiver.counters().frames;
  Cost cost = takeIn(ours, bytes, count);
  cost.frames = ours.receiver.counters().frames - before;
  return cost;
}

Cost take(Papers &papers, const uint8_t *bytes, size_t count) {
  const uint32_t before = papers.receiver.frames();
  Cost cost = takeIn(papers, bytes, count);
  cost.frames = papers.receiver.frames() - before;
  return cost;
}
