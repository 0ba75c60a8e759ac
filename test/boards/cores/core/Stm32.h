// github.com/stm32duino/Arduino_Core_STM32 2.12.0 (8c31e50): cores/arduino/HardwareSerial.h and .cpp,
// libraries/SrcWrapper uart.c. Characters with errors are kept (uart_getc(), uart.c:968), and so is what waits when
// begin() is called (HardwareSerial.cpp:390). With STM32F4 a chip that cannot invert: it ignores setRxInvert().
#pragma once

#include "../Stream.h"

#define ARDUINO_ARCH_STM32
#define SERIAL_RX_BUFFER_SIZE 64  // one place stays free
#define SERIAL_8N1 0x06
#define SERIAL_8E1 0x26
#define SERIAL_8E2 0x2E
#if !defined(STM32F4)
#define UART_ADVFEATURE_RXINVERT_INIT 2
#endif

class HardwareSerial : public Simulated<Stream> {
 public:
  HardwareSerial() : Simulated<Stream>({63, 1, 1, 63, 0, false, 0}) {}
  void begin(unsigned long baud) { begin(baud, SERIAL_8N1); }
  void begin(unsigned long baud, uint8_t config) {
    uart.change({baud, sim::evenStops<int>(config, SERIAL_8E1, SERIAL_8E2), _rxInverted, _txInverted});
  }
  void end() { uart.close(); }
  int availableForWrite() override { return uart.room(); }
  operator bool() { return uart.isOpen(); }
  void setRx(uint32_t) {}
  void setTx(uint32_t) {}
#if defined(STM32F4)
  void setRxInvert() {}
  void setTxInvert() {}
#else
  void setRxInvert() { _rxInverted = true; }  // for ever
  void setTxInvert() { _txInverted = true; }
#endif

 private:
  bool _rxInverted = false, _txInverted = false;
};
extern HardwareSerial Serial1, Serial2;
// cores/arduino/WSerial.h. A Nucleo's Serial is not Serial1; with NO_USB it is.
#if defined(NUCLEO)
#define SERIAL_UART_INSTANCE 2
#else
#define SERIAL_UART_INSTANCE 1
#define HAVE_HWSERIAL1
#endif
#if defined(NO_USB)
#define SBUS_PORT Serial1
#define Serial Serial1
#else
#define HAVE_SERIALUSB
#endif

#if defined(STM32F4)
constexpr sim::Known Core = {false, 2, 0, true};
#else
constexpr sim::Known Core = {true, 2, 0, true};
#endif
