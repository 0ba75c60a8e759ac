/// @file
/// How many bytes the cores' ports hold, how many they hand over at once, and how long they hold these back.
#pragma once

#include <Arduino.h>
#include <stdint.h>

#include "../sbus/LineTiming.h"
#include "Format.h"
#include "ReceiveNotice.h"

namespace sbus {

// The size assumed for an unknown port: the smallest of all cores (Pico). Too large a size would let lost bytes go
// unnoticed.
constexpr unsigned SmallestBuffer = 32;

#if defined(UART_RX_BUFFER_SIZE)  // STM32L0
constexpr unsigned CoreBuffer = UART_RX_BUFFER_SIZE;
#elif defined(SERIAL_RX_BUFFER_SIZE)   // AVR, STM32
constexpr unsigned CoreBuffer = SERIAL_RX_BUFFER_SIZE;
#elif defined(SERIAL_BUFFER_SIZE)      // SAMD, SAM, nRF52, Uno R4
constexpr unsigned CoreBuffer = SERIAL_BUFFER_SIZE;
#elif defined(SERIAL_8E1_RXINV_TXINV)  // Teensy, whose headers do not tell the size
constexpr unsigned CoreBuffer = 64;
#else
constexpr unsigned CoreBuffer = SmallestBuffer;
#endif

// A Teensy 4 also counts the bytes of its FIFO, which came after what its full buffer has lost (cores 7f107ee,
// teensy4/HardwareSerial.cpp:449, 642).
#if defined(SBUS_TEENSY4)
constexpr bool CountsFifo = true;
#else
constexpr bool CountsFifo = false;
#endif

// The size that begin() asks for where a port lets it: 30 ms of a line without gaps.
constexpr unsigned WantedBuffer = 256;

// The threshold of an ESP32's RX FIFO, characters: the default of 120 hides the gaps between frames. With the two idle
// characters that it waits for, that is less than LineTiming.h assumes.
constexpr uint8_t WantedBurst = 8;

// Tells an ESP32 how many characters make a burst. Cores before 2.0.3 cannot.
template <typename Port>
auto limitBursts(Port &port, uint8_t burst, Rank<1>) -> decltype(port.setRxFIFOFull(0), void()) {
  port.setRxFIFOFull(burst);
}
// Does nothing: other ports keep their burst.
template <typename Port>
void limitBursts(Port &, uint8_t, Rank<0>) {
}

// Gives arduino-pico's port a queue of WantedBuffer. Returns its size.
template <typename Port>
auto enlarge(Port &port, Rank<1>) -> decltype(port.setFIFOSize(0), 0u) {
  port.setFIFOSize(WantedBuffer);
  return WantedBuffer;
}
// Returns the smallest size: arduino-pico's SerialPIO has the size that the sketch gave it, which is unknown here.
template <typename Port>
unsigned enlarge(Port &, Rank<0>) {
  return SmallestBuffer;
}

// Returns for how many characters a port waits for more before it hands over less than a burst (LineTiming.h).
constexpr uint8_t idleCharacters(ReceiveNotice notice) {
  return notice == ReceiveNotice::EachCharacter || notice == ReceiveNotice::Fifo ? 0
         : notice == ReceiveNotice::Dma16                                     ? 1
                                                                           : MostIdleCharacters;
}

}  // namespace sbus
