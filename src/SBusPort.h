// All that differs between cores: how a port is opened and read, and what it holds. For sketches it only brings in what
// SERIAL_8E2 and the like are made of.
#pragma once

#include <Arduino.h>
#include <stddef.h>

#if defined(SERIAL_SBUS)
#include <stm32l0_uart.h>  // the option bits that SERIAL_SBUS is made of; Arduino.h does not bring them in
#endif

namespace sbus {

#if defined(SERIAL_SBUS)
constexpr auto PortConfig = SERIAL_SBUS;  // 8E2, inverted
#else
constexpr auto PortConfig = SERIAL_8E2;  // the line needs an inverter
#endif

// port.begin(baud, config), as open(port, &HardwareSerial::begin, baud, config): a format is a byte on some cores
// (AVR), 32 bits on others.
template <typename Format>
void open(HardwareSerial &port, void (HardwareSerial::*begin)(unsigned long, Format), unsigned long baud,
          uint32_t config) {
  (port.*begin)(baud, static_cast<Format>(config));
}

// The core's buffer. A poll that finds this many bytes, or one less, may have found it full, and then the core has
// dropped the newest bytes: the break lies after the last one. One less, because a core may keep a place free (AVR).
constexpr int BufferSize = 64;
constexpr int BufferFull = BufferSize - 1;

// Reads in one call where the core has read(buffer, size),
template <typename Port>
auto readWaiting(Port &port, uint8_t *buffer, size_t size, int) -> decltype(port.read(buffer, size)) {
  return port.read(buffer, size);
}

// else byte by byte.
template <typename Port>
int readWaiting(Port &port, uint8_t *buffer, size_t size, long) {
  size_t count = 0;
  for (int byte; count < size && (byte = port.read()) >= 0; count++) {
    buffer[count] = static_cast<uint8_t>(byte);
  }
  return static_cast<int>(count);
}

// Reads `size` bytes, which are there: never more than available() said, because the STM32L0's core would then write
// past the end of `buffer`. Returns how many there were.
inline int read(HardwareSerial &port, uint8_t *buffer, size_t size) {
  return readWaiting(port, buffer, size, 0);
}

}  // namespace sbus
