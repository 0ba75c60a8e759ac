// github.com/arduino/ArduinoCore-sam 1.6.12 (790ff2c): cores/arduino/HardwareSerial.h, UARTClass.h, USARTClass.h,
// Print.h. Characters with errors are kept (UARTClass.cpp:174), begin() clears what waits (74). Two enums are formats;
// Print and HardwareSerial know less than the ports.
#pragma once

#define PRINT_WITHOUT_ROOM
#include "../Stream.h"

#define ARDUINO_ARCH_SAM
#define NO_EEPROM
#define SERIAL_BUFFER_SIZE 128  // one place stays free
#define SERIAL_8N1 UARTClass::Mode_8N1
#define SERIAL_8E1 UARTClass::Mode_8E1
#define SERIAL_8E2 USARTClass::Mode_8E2

class HardwareSerial : public Stream {
 public:
  virtual void begin(unsigned long) = 0;
  virtual void end() = 0;
  using Print::write;
  virtual operator bool() = 0;
};
class UARTClass : public Simulated<HardwareSerial> {
 public:
  enum UARTModes { Mode_8N1 = 0x800, Mode_8E1 = 0x000 };
  UARTClass() : Simulated<HardwareSerial>({127, 1, 1, 127, sim::End, false, 0}) {}
  void begin(const unsigned long baud) override { begin(baud, Mode_8N1); }
  void begin(const unsigned long baud, const UARTModes config) { open(baud, config == Mode_8E1 ? 1 : 0); }
  void end() override { uart.close(); }
  int availableForWrite() { return uart.room(); }
  operator bool() override { return true; }

 protected:
  void open(unsigned long baud, unsigned evenStops) {
    uart.open({baud == 0 ? 0 : 84000000 / 16 / (84000000 / 16 / baud), evenStops, false, false});
  }
};
class USARTClass : public UARTClass {
 public:
  enum USARTModes { Mode_8N2 = 0x28C0, Mode_8E2 = 0x20C0 };
  using UARTClass::begin;
  void begin(const unsigned long baud, const USARTModes config) { open(baud, config == Mode_8E2 ? 2 : 0); }
};
extern USARTClass Serial1, Serial2;

constexpr sim::Known Core = {false, 2, 0, false};
