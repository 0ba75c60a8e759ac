// A serial port over the board's receive path. If it is opened at another baud rate than the wire's it hears nothing.
// Before every read it tells its observer: a class that takes in two frames in one call has finished with the first
// then, and can be asked for it.
#pragma once

#include <FakeClock.h>
#include <runtime/BoardUart.h>
#include <runtime/Wire.h>

// Last: its macros min and max break the standard headers behind it.
#include <Arduino.h>

class ReadObserver {
 public:
  virtual ~ReadObserver() = default;
  virtual void beforeRead() = 0;
};

class UartPort : public HardwareSerial {
 public:
  UartPort(ReadObserver &observer, unsigned long wireBaud) : _observer(observer), _wireBaud(wireBaud) {}

  host::BoardUart uart;
  uint64_t bytesRead = 0;

  void begin(unsigned long baud) override { begin(baud, 0); }
  void begin(unsigned long baud, uint32_t) override {
    _baud = baud;
    uart.open(fakeMicros, host::Wire{baud}.characterUs());
  }
  void receive(const host::Character &character) {
    if (_baud == _wireBaud) {
      uart.receive(character);
    }
  }
  void end() override { uart.close(); }
  int available() override { return uart.available(); }
  int peek() override { return uart.peek(); }
  int read() override {
    _observer.beforeRead();
    const int value = uart.read();
    bytesRead += value >= 0;
    return value;
  }
#if !defined(HOST_PLAIN_CORE)
  int read(uint8_t *buffer, size_t size) override {
    _observer.beforeRead();
    const int count = uart.read(buffer, size);
    bytesRead += static_cast<uint64_t>(count);
    return count;
  }
#endif
  void flush() override {}
  size_t write(uint8_t) override { return 0; }
  operator bool() override { return uart.isOpen(); }

 private:
  ReadObserver &_observer;
  const unsigned long _wireBaud;
  unsigned long _baud = 0;
};
