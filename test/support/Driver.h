// How a core's driver hands over what has come in.
#pragma once

// So many characters at once, or fewer when the line has been idle for so long.
struct Driver {
  const char *name;
  unsigned burst;
  unsigned idleCharacters;

  bool isBoards() const { return burst == 16; }
};
constexpr Driver Board = {"board", 16, 1};  // half of its DMA's ring
constexpr Driver ByteByByte = {"bytes", 1, 0};  // AVR
constexpr Driver Fifo = {"FIFO 8", 8, 3};   // RP2040: when it has been idle for 32 bits
constexpr Driver Esp32 = {"ESP32", 120, 2};       // as the sketch opens it
constexpr Driver Esp32Told = {"ESP32, 8", 8, 2};  // as DecodeSBus::begin() does
