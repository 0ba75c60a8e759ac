#include "Cost.h"

namespace {

uint32_t available;
uint32_t singleRead;
uint32_t read;
uint32_t perByte;

uint8_t buffer[64];

__attribute__((noinline)) int nothing(MemorySerial &port, uint8_t *bytes, size_t size) {
  __asm__ volatile("" : : "r"(&port), "r"(bytes), "r"(size));
  return 0;
}

uint32_t ownOfReading(size_t size) {
  MemorySerial port;
  port.put(buffer, sizeof buffer);
  const uint32_t none = instructions::of([&] { nothing(port, buffer, size); }) - 1;  // it is only its return
  return instructions::of([&] { port.read(buffer, size); }) - none;
}

}  // namespace

bool calibrate() {
  instructions::start();
  MemorySerial port;
  port.put(buffer, sizeof buffer);
  const uint32_t none = instructions::of([&] { nothing(port, buffer, 25); }) - 1;
  available = instructions::of([&] { port.available(); }) - none;
  singleRead = instructions::of([&] { port.read(); }) - none;
  read = ownOfReading(0);
  perByte = ownOfReading(1) - read;
  return instructions::calibrated() && ownOfReading(63) == read + 63 * perByte;
}

uint32_t portsOwn(const MemorySerial::Calls &calls) {
  return available * calls.available + singleRead * calls.singleReads + read * calls.reads + perByte * calls.bytes;
}
