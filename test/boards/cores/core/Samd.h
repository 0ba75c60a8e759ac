// github.com/arduino/ArduinoCore-samd 1.8.14 (993398c): cores/arduino/Uart.h and .cpp, SERCOM.cpp, main.cpp.
// A framing error is discarded (Uart.cpp:93), a parity error kept (101). begin() keeps what waits (48), end() resets
// the UART at once (77). Adafruit's core for the SAMD51 (1.7.17, 26c39c0) does the same; its buffer is larger.
#pragma once

#include "Api.h"

#define ARDUINO_ARCH_SAMD
#define NO_EEPROM
#define SERIAL_BUFFER_SIZE 256

class Uart : public Simulated<HardwareSerial> {
 public:
  Uart() : Simulated<HardwareSerial>({256, 1, 1, 256, sim::End, false, sim::Framing}) {}
  void begin(unsigned long baud) override { begin(baud, SERIAL_8N1); }
  void begin(unsigned long baud, uint16_t config) override { uart.change(apiSettings(baud, config)); }
  void end() override { uart.cut(); }
  int availableForWrite() override { return uart.room(); }
  operator bool() override { return true; }
};
extern Uart Serial1, Serial2;

// CMSIS, and cores/arduino/hooks.c:43, cortex_handlers.c:42: what calls each millisecond.
enum IRQn_Type { PendSV_IRQn = -2 };
#define __NVIC_PRIO_BITS 2
#define SCB_ICSR_PENDSVSET_Msk (1u << 28)
#define SCB sim::scb()
namespace sim {
struct Icsr {
  Icsr &operator=(uint32_t bits);
};
struct Scb {
  Icsr ICSR;
};
Scb *scb();
}  // namespace sim
void NVIC_SetPriority(IRQn_Type number, uint32_t priority);
extern "C" int sysTickHook();
extern "C" void PendSV_Handler();

constexpr sim::Known Core = {false, 2, 0, true};
