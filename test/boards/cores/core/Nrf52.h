// github.com/adafruit/Adafruit_nRF52_Arduino 1.7.0 (fa129c2): cores/nRF5/HardwareSerial.h, Uart.h and .cpp, main.cpp.
// 100000 baud becomes 115200, until NRF_UARTE0->BAUDRATE is written. begin() of an open port does nothing
// (Uart.cpp:75); end() of a closed one waits for ever, of an open one stops what is being sent (164, 168); characters
// with errors are kept (200).
#pragma once

#include "../Stream.h"

#define ARDUINO_ARCH_NRF52
#define NRF52_SERIES
#define NO_EEPROM
#define CLOCK_HZ 1024          // micros() is the tick of FreeRTOS (delay.h:60, FreeRTOSConfig.h)
#define SERIAL_BUFFER_SIZE 64  // one place stays free
#define SERIAL_8N1 0x00
#define SERIAL_8E1 0x0E
#define SERIAL_8E2 0x1E

class HardwareSerial : public Stream {
 public:
  virtual void begin(unsigned long) = 0;
  virtual void begin(unsigned long baud, uint16_t config) = 0;
  virtual void end() = 0;
  using Print::write;
  virtual operator bool() = 0;
};
class Uart : public Simulated<HardwareSerial> {
 public:
  Uart() : Simulated<HardwareSerial>({63, 1, 1, 64, sim::End | sim::Write | sim::Room, false, 0}) {}
  void begin(unsigned long baud) override { begin(baud, SERIAL_8N1); }
  void begin(unsigned long baud, uint16_t config) override {
    if (!uart.isOpen()) {
      const unsigned long real = baud <= 76800 ? baud : baud <= 115200 ? 115200 : 230400;
      uart.open({real, sim::evenStops<int>(config, SERIAL_8E1, SERIAL_8E2), false, false});
    }
  }
  void end() override { uart.cut(); }
  int availableForWrite() override { return uart.room() == 64 ? 64 : 0; }  // one transfer at a time
  using Print::write;
  size_t write(const uint8_t *bytes, size_t size) override {
    uart.flush();
    return Print::write(bytes, size);
  }
  operator bool() override { return uart.isOpen(); }
};
extern Uart Serial1, Serial2;

// The registers of Serial1; a Feather has no other port.
constexpr uint32_t UARTE_CONFIG_HWFC_Msk = 1;
struct NRF_UARTE_Type {
  class Register {
   public:
    void operator=(uint32_t value) {
      _value = value;
      registers().apply();
    }
    operator uint32_t() const { return _value; }

   private:
    uint32_t _value = 0;
  } CONFIG, BAUDRATE;
  static NRF_UARTE_Type &registers() {
    static NRF_UARTE_Type only;
    return only;
  }

 private:
  void apply() const {
    const uint64_t baud = uint64_t{BAUDRATE} * 16000000 >> 32;
    const int format = static_cast<int>(CONFIG & ~UARTE_CONFIG_HWFC_Msk);
    Serial1.uart.change(
        {static_cast<unsigned long>(baud), sim::evenStops(format, SERIAL_8E1, SERIAL_8E2), false, false});
  }
};
#define NRF_UARTE0 (&NRF_UARTE_Type::registers())

constexpr sim::Known Core = {false, 2, 0, true};

#define OPENED_BY_HAND
inline void openByHand() {
  Serial1.begin(115200, SERIAL_8E2);
  NRF_UARTE0->CONFIG = SERIAL_8E2;
  NRF_UARTE0->BAUDRATE = 0x0199A000;
}
