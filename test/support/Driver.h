// How a core's driver hands over received characters.
#pragma once

// Hands over `burst` characters at once, or fewer when the line was idle for `idleCharacters`. Drops characters with
// errors. While interrupts are off the UART keeps the first `keeps` characters and loses all others. If `overflowUs` is
// not 0, micros() is made of interrupts that come this often, and at most one of them waits: the clock stands still.
struct Driver {
  const char *name;
  unsigned burst;
  unsigned idleCharacters;
  unsigned keeps = 0;
  uint32_t overflowUs = 0;

  bool isBoards() const { return burst == 16; }
  bool fromCallback() const { return keeps != 0; }  // and its class says so
};

// GrumpyOldPizza/ArduinoCore-stm32l0 b1cf1cd, system/STM32L0xx/Source/stm32l0_uart.c: a DMA ring of 32 (variants/*/
// variant.cpp: stm32l0_usart1_rx_fifo) is handed over at its half and its end, regardless of frames (53, 280), when the
// line is idle for a character (653), and before a character with an error, which is dropped (529). Without room, the
// newest are dropped (125). begin() empties the ring and restarts it (379). host::BoardUart does all this.
constexpr Driver Board = {"board", 16, 1};

// arduino/ArduinoCore-avr 11b9130, cores/arduino/HardwareSerial_private.h:101: an interrupt a character. Only a parity
// error drops one (103); with a framing error it stays. So do cores whose available() looks into the UART's FIFO:
// arduino-pico 387294c, cores/rp2040/SerialUART.cpp:344, 415; Teensy 4, PaulStoffregen/cores 7f107ee, teensy4/
// HardwareSerial.cpp:449.
constexpr Driver ByteByByte = {"bytes", 1, 0};

// With interrupts off. An AVR keeps two characters and one in its shift register (ATmega2560 datasheet, 22.7.3), and
// counts one overflow of timer 0, after 1024 us (ArduinoCore-avr, cores/arduino/wiring.c:94). A Pico keeps 32 (RP2040
// datasheet, 4.2.2.4), and its clock runs on. The third has an AVR's UART and a Pico's clock.
constexpr Driver Avr = {"AVR", 1, 0, 3, 1024};
constexpr Driver Pico = {"Pico", 1, 0, 32};
constexpr Driver Three = {"FIFO 3", 1, 0, 3};

// espressif/arduino-esp32, cores/esp32/HardwareSerial.cpp, begin(): "fifoFull = 120" above 57600 baud; _rxTimeout is 2
// characters in core 2.0, and 1 in core 3. espressif/esp-idf 1021229, components/esp_driver_uart/src/uart.c:1341, then
// empties the FIFO. A character with an error stays in it (nothing calls uart_ll_discard_error_data()): that is a line
// with flipped bits.
constexpr Driver Esp32 = {"ESP32", 120, 2};       // as the sketch opens it
constexpr Driver Esp32Told = {"ESP32, 8", 8, 2};  // as DecodeSBus::begin() sets it

// The most that a receiver has to tolerate; no current core holds back as much. Before 1.13.1 (53043830) arduino-pico
// held back 4 characters, or fewer for 32 bits.
constexpr Driver Fifo = {"FIFO 8", 8, 4};
