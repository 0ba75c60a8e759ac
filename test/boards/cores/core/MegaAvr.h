// github.com/arduino/ArduinoCore-megaavr 1.8.8 (bbdfd4b): cores/arduino/UART.h, UART.cpp, UART_private.h, of a Nano Every. With
// DXCORE github.com/SpenceKonde/DxCore 1.6.3 (c92e357), as megaTinyCore 2.6.11 (b5758d2): cores/dxcore/HardwareSerial.h,
// UART.cpp. A character with a parity error is discarded, one with a framing error is kept (UART_private.h:55; DxCore,
// UART.cpp:198). begin() keeps what waits, unless something was sent: then it calls end() (UART.cpp:144; 546), which clears it
// (200; 698). The pin can invert: begin() and end() leave that alone, since pinMode() does (wiring_digital.c:64; 95).
#pragma once

#if defined(DXCORE)
#include "../Stream.h"
#else
#include "Api.h"
#undef SERIAL_8N1
#undef SERIAL_8E1
#undef SERIAL_8E2
#endif

#define ARDUINO_ARCH_MEGAAVR
#define SERIAL_RX_BUFFER_SIZE 64  // one place stays free
#define SERIAL_8N1 0x03
#define SERIAL_8E1 0x23
#define SERIAL_8E2 0x2B
#define PORT_INVEN_bm 0x80

template <class Base>
class MegaAvr : public Simulated<Base> {
 public:
  MegaAvr() : Simulated<Base>({63, 1, 1, 63, 0, false, sim::Parity}) {}
  void begin(unsigned long baud) { begin(baud, SERIAL_8N1); }
  void begin(unsigned long baud, uint16_t config) {
    if (_written) {
      end();
    }
    this->uart.change({baud, sim::evenStops<int>(config, SERIAL_8E1, SERIAL_8E2), _rxInverted, false});
  }
  void end() {
    this->uart.close();
    _written = false;
  }
  int availableForWrite() override { return this->uart.room(); }
  using Print::write;
  size_t write(uint8_t byte) override {
    _written = true;
    return Simulated<Base>::write(byte);
  }
  operator bool() { return true; }

  void operator|=(uint8_t bits) {
    _rxInverted = _rxInverted || (bits & PORT_INVEN_bm) != 0;
    if (this->uart.isOpen()) {
      sim::Settings settings = this->uart.settings();
      settings.rxInverted = _rxInverted;
      this->uart.change(settings);
    }
  }

 private:
  bool _written = false, _rxInverted = false;
};

#if defined(DXCORE)
class HardwareSerial : public MegaAvr<Stream> {};
#if defined(ONE_PORT)  // an ATtiny 0 or 1
#define SBUS_PORT Serial
extern HardwareSerial Serial;
#define Serial1 Serial
#else
#define USART1 (*(USART_t *)0x0820)  // of the chip; HardwareSerial.h asks for it, and defines no HAVE_HWSERIAL1
extern HardwareSerial Serial1, Serial2;
#endif
constexpr bool CallsSerialEvent1 = false;
#else
class UartClass : public MegaAvr<HardwareSerial> {};
#define HAVE_HWSERIAL1
extern UartClass Serial1, Serial2;
constexpr bool CallsSerialEvent1 = true;
#endif

constexpr sim::Known Core = {false, CallsSerialEvent1, 100000, 2, 0, true, true};

// The register of Serial1's RX.
struct Port {
  decltype(Serial1) &PIN5CTRL;
};
#define PORTC (Port{Serial1})
