// How the board receives: the path of the characters from the wire to the sketch's read().
#pragma once

#include <cstddef>
#include <cstdint>

#include <stm32l0_uart.h>

#include "line/Line.h"

namespace host {

// The UART's DMA fills a ring of 32 bytes. The ring is handed over to the receive buffer at its middle, at its end,
// when the line has been idle for a character, and when a character has an error. If the buffer is full, the newest
// bytes are dropped; characters with errors are always dropped. A sketch can see neither.
//
// Time comes in as an argument and must not go backwards.
class BoardUart {
 public:
  static constexpr size_t RingSize = 32;
  static constexpr size_t HandOverSize = RingSize / 2;
  static constexpr size_t BufferSize = 64;
  static constexpr size_t BufferMinimum = 16;  // a port rejects smaller buffers

  BoardUart() = default;
  BoardUart(const BoardUart &) = delete;  // it may point into itself
  BoardUart &operator=(const BoardUart &) = delete;

  // Opens with an empty ring and an empty buffer, its own or a given one, for characters of this length. A character
  // that began earlier is not received.
  void open(uint64_t nowUs, uint32_t characterUs = line::CharacterUs) {
    open(nowUs, _ownBuffer, BufferSize, characterUs);
  }
  void open(uint64_t nowUs, uint8_t *buffer, size_t size, uint32_t characterUs = line::CharacterUs);
  void close() { _open = false; }
  bool isOpen() const { return _open; }

  // Takes a character from the wire.
  void receive(const line::Character &character);

  // Takes the time up to which there are no further characters.
  void advance(uint64_t nowUs);

  // Returns when the line will have been idle for a character's time, if no character arrives.
  uint64_t idleFromUs() const { return _lastEndUs + _characterUs; }

  // Interrupts are masked from now on, or no longer: the DMA goes on, and what should have been handed over meanwhile
  // is at the end, with all that has come by then (stm32l0_uart_dma_receive() takes the DMA's count,
  // stm32l0_uart.c:99).
  void mask(bool isMasked);

  // These are the sketch's calls. A closed port has nothing to read: then read() and peek() return -1.
  int available() const { return _open ? static_cast<int>(_state.rx_count) : 0; }
  int peek();
  int read();
  int read(uint8_t *buffer, size_t size);  // returns the number of bytes read, up to `size`

  // Returns true, once, if bytes have been handed over: the first ones after open() and after each poll of the buffer.
  bool takeReceiveEvent();

  // Returns the core's state of the port. rx_index goes on with each byte handed over, and a silence does not change it
  // (stm32l0_uart.c:99): so it lies between two halves of the ring only if the line was idle after the newest byte, or
  // the next character had an error.
  stm32l0_uart_t &state() { return _state; }

  // Return the number of bytes dropped since the program's start.
  unsigned long droppedBad() const { return _droppedBad; }
  unsigned long droppedFull() const { return _droppedFull; }

 private:
  void handOver();

  bool _open = false;
  bool _isMasked = false;
  bool _isDue = false;  // while it was masked the ring should have been handed over
  uint64_t _openedUs = 0;
  uint64_t _lastEndUs = 0;
  uint32_t _characterUs = line::CharacterUs;

  uint8_t _ring[RingSize] = {};
  size_t _ringWrite = 0;

  uint8_t _ownBuffer[BufferSize] = {};
  uint8_t *_buffer = _ownBuffer;
  size_t _size = BufferSize;
  size_t _first = 0;
  stm32l0_uart_t _state{};

  bool _event = false;

  unsigned long _droppedBad = 0;
  unsigned long _droppedFull = 0;
};

}  // namespace host
