// github.com/GrumpyOldPizza/ArduinoCore-stm32l0 1.6.18 (b1cf1cd): cores/arduino/HardwareSerial.h, Uart.h;
// system/STM32L0xx/Source/stm32l0_uart.c. Characters with errors are discarded (stm32l0_uart.c:529). begin()
// ends an open port, end() of a closed one does nothing (Uart.cpp:85, 103). The formats are made of names that
// Arduino.h does not bring in. This port does not call back (Uart.cpp:367 takes a Callback): as a HardwareSerial & it
// is polled. extras/host's calls back.
#pragma once

#include "../Stream.h"
#include <stm32l0_system.h>

#include "Callback.h"
#include "PinDescription.h"

#define ARDUINO_ARCH_stm32l0
#define UART_RX_BUFFER_SIZE 64
#define SERIAL_8N1 (STM32L0_UART_OPTION_DATA_SIZE_8 | STM32L0_UART_OPTION_PARITY_NONE | STM32L0_UART_OPTION_STOP_1)
#define SERIAL_8E1 (STM32L0_UART_OPTION_DATA_SIZE_8 | STM32L0_UART_OPTION_PARITY_EVEN | STM32L0_UART_OPTION_STOP_1)
#define SERIAL_8E2 (STM32L0_UART_OPTION_DATA_SIZE_8 | STM32L0_UART_OPTION_PARITY_EVEN | STM32L0_UART_OPTION_STOP_2)
#define SERIAL_SBUS (SERIAL_8E2 | STM32L0_UART_OPTION_RX_INVERT | STM32L0_UART_OPTION_TX_INVERT)

class HardwareSerial : public Stream {
 public:
  virtual void begin(unsigned long) {}
  virtual void begin(unsigned long, uint32_t) {}
  virtual void end() {}
  using Stream::read;
  virtual int read(uint8_t *buffer, size_t size) = 0;
  virtual operator bool() = 0;
};
class Uart : public Simulated<HardwareSerial> {
 public:
  Uart() : Simulated<HardwareSerial>({64, 16, 1, 64, 0, true, sim::Parity | sim::Framing}) {}
  void begin(unsigned long baud) override { begin(baud, 0); }
  void begin(unsigned long baud, uint32_t config) override;  // below, where its bits are known
  void begin(unsigned long baud, uint8_t *buffer, size_t size);
  void begin(unsigned long baud, uint32_t config, uint8_t *buffer, size_t size);
  void end() override { uart.close(); }
  using Simulated<HardwareSerial>::read;
  int read(uint8_t *buffer, size_t size) override { return uart.read(buffer, size); }
  int availableForWrite() override { return uart.room(); }
  void onReceive(void (*callback)());
  operator bool() override { return true; }
};
extern Uart Serial1, Serial2;

#if !defined(STM32L0_CORE_0_0)
inline void stm32l0_system_register(stm32l0_system_notify_t *, stm32l0_system_callback_t, void *, uint32_t) {}
inline void stm32l0_system_unregister(stm32l0_system_notify_t *) {}
#endif

// The values are extras/host's.
inline void Uart::begin(unsigned long baud, uint32_t config) {
  constexpr uint32_t E1 = 0x12, E2 = 0x13, Rx = 0x20, Tx = 0x40;
  uart.open({baud, sim::evenStops(config & ~(Rx | Tx), E1, E2), (config & Rx) != 0, (config & Tx) != 0});
}

constexpr sim::Known Core = {true, 2, 0, true};
