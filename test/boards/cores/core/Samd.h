// github.com/arduino/ArduinoCore-samd 1.8.14 (993398c): cores/arduino/Uart.h and .cpp, SERCOM.cpp, main.cpp.
// A framing error is discarded (Uart.cpp:93), a parity error kept (101). begin() keeps what waits (48), end() resets the UART
// at once (77). With SAMD51
// github.com/adafruit/ArduinoCore-samd 1.7.17 (26c39c0): the same (Uart.cpp:93, 101, 70) but for its buffer
// (RingBuffer.h:32).
#pragma once

#include "Api.h"

#define ARDUINO_ARCH_SAMD
#define NO_EEPROM
#if defined(SAMD51)
#define SERIAL_BUFFER_SIZE 350
constexpr unsigned Holds = 349;  // RingBuffer.h:76
#else
#define SERIAL_BUFFER_SIZE 256
constexpr unsigned Holds = 256;
#endif

class Uart : public Simulated<HardwareSerial> {
 public:
  Uart() : Simulated<HardwareSerial>({Holds, 1, 1, Holds, sim::End, false, sim::Framing}) {}
  void begin(unsigned long baud) override { begin(baud, SERIAL_8N1); }
  void begin(unsigned long baud, uint16_t config) override { uart.change(apiSettings(baud, config)); }
  void end() override { uart.cut(); }
  int availableForWrite() override { return uart.room(); }
  operator bool() override { return true; }
};
extern Uart Serial1, Serial2;

// CMSIS, and cores/arduino/hooks.c:43, cortex_handlers.c:42: what calls each millisecond.
enum IRQn_Type { PendSV_IRQn = -2 };
#if defined(SAMD51)
#define __NVIC_PRIO_BITS 3
#else
#define __NVIC_PRIO_BITS 2
#endif
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

constexpr sim::Known Core = {false, false, 100000, 2, 0, true, true};
