/// @file
/// Sends on a port of the STM32L0 by DMA. The core's own way needs an interrupt for each character: if one comes late
/// by a character, even once, the port sends the contents of the flash forever (stm32l0_uart.c:703: TC is served while
/// TXEIE is on, then `tx_data` counts up from address 0).
#pragma once

#include <Arduino.h>
#include <stddef.h>
#include <stdint.h>

#include "Core.h"

#if defined(SBUS_STM32L0) && defined(DMA1_Channel2)
#define SBUS_DMA_SENDER

namespace sbus {

// The characters are copied, and sending needs no interrupt: whatever happens, the port sends these characters, one
// directly after the other, and nothing else.
class DmaSender {
 public:
  static constexpr size_t Room = 36;  // characters: the longest frame

  // Returns true if `port` is one of the board's Uarts.
  static bool knows(const HardwareSerial *port);
  // Returns Room if it takes characters now; 0 while it sends, and always if SPI or Wire has its DMA channels.
  static size_t room(const HardwareSerial *port);
  // Sends up to Room characters. Returns false, and sends nothing, if room() is 0.
  static bool send(const HardwareSerial *port, const uint8_t *characters, size_t size);
  // Returns true if no character has come in since the port last called because half of its ring was full.
  static bool cameAtOnce(const HardwareSerial *port);
  // Returns true while a character comes in.
  static bool hears(const HardwareSerial *port);
  // Waits until the last character has gone out. Null if the sketch does not send: the linker takes this class from the
  // library's archive (`dot_a_linkage`) only for another method.
  __attribute__((weak)) static void flush(const HardwareSerial *port);
};

}  // namespace sbus

#endif
