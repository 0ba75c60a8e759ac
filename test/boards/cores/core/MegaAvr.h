// github.com/arduino/ArduinoCore-megaavr 1.8.8 (bbdfd4b): cores/arduino/UART.h, UART.cpp, UART_private.h, of a Nano
// Every. DxCore 1.6.3 (github.com/SpenceKonde/DxCore c92e357) and megaTinyCore 2.6.11 (b5758d2) do the same
// (cores/dxcore/UART.cpp). A character with a parity error is discarded, one with a framing error is kept
// (UART_private.h:55; DxCore, UART.cpp:198). begin() keeps what waits, unless something was sent: then it calls end()
// (UART.cpp:144; 546), which clears it (200; 698). The pin can invert: begin() and end() leave that alone, since
// pinMode() does (wiring_digital.c:64; 95).
#pragma once

#include "Api.h"
#undef SERIAL_8N1
#undef SERIAL_8E1
#undef SERIAL_8E2

#define ARDUINO_ARCH_MEGAAVR
#define SERIAL_RX_BUFFER_SIZE 64  // one place stays free
#define SERIAL_8N1 0x03
#define SERIAL_8E1 0x23
#define SERIAL_8E2 0x2B
#define PORT_INVEN_bm 0x80

class UartClass : public Simulated<HardwareSerial> {
 public:
  UartClass() : Simulated<HardwareSerial>({63, 1, 1, 63, 0, false, sim::Parity}) {}
  void begin(unsigned long baud) override { begin(baud, SERIAL_8N1); }
  void begin(unsigned long baud, uint16_t config) override {
    if (_written) {
      end();
    }
    uart.change({baud, sim::evenStops<int>(config, SERIAL_8E1, SERIAL_8E2), _rxInverted, false});
  }
  void end() override {
    uart.close();
    _written = false;
  }
  int availableForWrite() override { return uart.room(); }
  using Print::write;
  size_t write(uint8_t byte) override {
    _written = true;
    return Simulated<HardwareSerial>::write(byte);
  }
  operator bool() override { return true; }

  void operator|=(uint8_t bits) {
    _rxInverted = _rxInverted || (bits & PORT_INVEN_bm) != 0;
    if (uart.isOpen()) {
      sim::Settings settings = uart.settings();
      settings.rxInverted = _rxInverted;
      uart.change(settings);
    }
  }

 private:
  bool _written = false, _rxInverted = false;
};

#if defined(ONE_PORT)  // an ATtiny 0 or 1
#define SBUS_PORT Serial
extern UartClass Serial;
#define Serial1 Serial
#else
#if defined(MEGATINYCORE)  // an ATtiny 2: of the chip; HardwareSerial.h asks for it, and defines no HAVE_HWSERIAL1
#define USART1 (*(USART_t *)0x0820)
#else
#define HAVE_HWSERIAL1
#endif
extern UartClass Serial1, Serial2;
#endif

constexpr sim::Known Core = {false, 2, 0, true};

// The register of Serial1's RX.
struct Port {
  decltype(Serial1) &PIN5CTRL;
};
#define PORTC (Port{Serial1})
