// A serial port that receives as a board's driver does: characters of a line go in, a sketch reads bytes. Opened at a
// baud rate other than the line's, it receives nothing.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "CleanArduino.h"
#include "Driver.h"
#include "FakeClock.h"
#include "board/BoardUart.h"
#include "line/LineSettings.h"

class UartPort : public HardwareSerial {
 public:
  // Calls `beforeRead` before every read: a class that takes in two frames in one call has then finished with the
  // first, which can be read.
  explicit UartPort(
      unsigned long lineBaud = sbus::Baud, const Driver &driver = Board, size_t buffer = 64,
      std::function<void()> beforeRead = [] {})
      : _lineBaud(lineBaud), _driver(driver), _buffer(buffer), _beforeRead(std::move(beforeRead)) {}

  void begin(unsigned long baud) override { begin(baud, 0); }
  void begin(unsigned long baud, uint32_t) override {
    _baud = baud;
    _characterUs = line::LineSettings{baud}.characterUs();
    _openedUs = fakeMicros;
    _fifo.clear();
    _uart.open(fakeMicros, _buffer.data(), _buffer.size(), _characterUs);
  }

  // Takes the next character of the line.
  void receive(const line::Character &character) {
    if (_baud != _lineBaud || character.endUs < _openedUs + _characterUs) {
      return;  // a character that began before the port was opened is not received
    }
    if (!_interrupts) {
      if (_kept.size() < _driver.keeps) {
        _kept.push_back(character);
      } else {
        _lostBehindKept += !character.bad;
      }
      return;
    }
    advance(character.endUs - _characterUs);
    if (_driver.isBoards()) {
      _uart.receive(character);
      return;
    }
    _fifo.push_back(character);
    if (_fifo.size() >= _driver.burst) {
      handOver();
    }
  }
  void advance(uint64_t nowUs) {
    if (_driver.isBoards()) {
      _uart.advance(nowUs);
    } else if (!_fifo.empty() && nowUs >= _fifo.back().endUs + _driver.idleCharacters * _characterUs) {
      handOver();
    }
  }

  // While interrupts are off no character is handed over.
  void interruptsOff() {
    _interrupts = false;
    _lostBehindKept = 0;
  }
  // Hands over what the UART has kept. Returns how many good characters it lost after that.
  uint64_t interruptsOn() {
    _interrupts = true;
    for (const line::Character &character : _kept) {
      receive(character);
    }
    _kept.clear();
    return _lostBehindKept;
  }

  // Interrupts are masked on a board whose DMA goes on.
  void mask(bool isMasked) { _uart.mask(isMasked); }

  uint64_t bytesRead() const { return _bytesRead; }
  unsigned reads() const { return _reads; }  // calls that took bytes
  unsigned asked() const { return _asked; }  // calls of available()
  uint64_t droppedFull() const { return _uart.droppedFull(); }

  // Returns when the line will have been idle for a character, if no other comes.
  uint64_t idleFromUs() const { return _uart.idleFromUs(); }

  void end() override { _uart.close(); }
  int available() override {
    _asked++;
    return _uart.available();
  }
  int peek() override { return _uart.peek(); }
  int read() override {
    uint8_t value;
    return take(&value, 1) == 1 ? value : -1;
  }
  int read(uint8_t *buffer, size_t size) override { return take(buffer, size); }
  void flush() override {}
  size_t write(uint8_t) override { return 0; }
  operator bool() override { return _uart.isOpen(); }

 protected:
  host::BoardUart &uart() { return _uart; }

 private:
  int take(uint8_t *buffer, size_t size) {
    _beforeRead();
    const int count = _uart.read(buffer, size);
    _bytesRead += static_cast<uint64_t>(count);
    _reads += count > 0;
    return count;
  }

  // Changes the board's receive path to one without its ring: it is idle after each character.
  void handOver() {
    for (const line::Character &character : _fifo) {
      _uart.receive(character);
      _uart.advance(character.endUs + _characterUs);
    }
    _fifo.clear();
  }

  const unsigned long _lineBaud;
  const Driver _driver;
  std::vector<uint8_t> _buffer;
  const std::function<void()> _beforeRead;
  unsigned long _baud = 0;
  uint64_t _openedUs = 0;
  uint32_t _characterUs = 0;
  uint64_t _bytesRead = 0;
  unsigned _reads = 0;
  unsigned _asked = 0;
  host::BoardUart _uart;
  std::vector<line::Character> _fifo;
  bool _interrupts = true;
  std::vector<line::Character> _kept;  // while they are off
  uint64_t _lostBehindKept = 0;
};

// A port that hands over each character at once: by its setInvertRX() the library knows that.
class PromptPort : public UartPort {
 public:
  using UartPort::UartPort;
  bool setInvertRX(bool) { return true; }
  bool setInvertTX(bool) { return true; }
  bool setFIFOSize(size_t) { return true; }
};

// The board's port: by its onReceive() the library knows how long it waits for more characters. The event that calls
// back never comes.
class BoardsPort : public UartPort {
 public:
  using UartPort::UartPort;
  void onReceive(void (*)()) {}
};

// The board's port, which calls back: it notes the event when bytes are handed over, until they are read
// (GrumpyOldPizza/ArduinoCore-stm32l0 b1cf1cd, stm32l0_uart.c:99, 1171), and PendSV makes the call, which does not
// interrupt itself (Uart.cpp:385, armv6m_pendsv.c:133). begin() and end() keep the callback. Call callBack() wherever
// PendSV would come.
class CallingPort : public BoardsPort {
 public:
  using BoardsPort::BoardsPort;

  using UartPort::begin;
  void begin(unsigned long baud, uint32_t config, uint8_t *, size_t) { begin(baud, config); }
  using BoardsPort::onReceive;
  void onReceive(Callback callback) { _callback = callback; }

  // Returns true if an event waits; with `isLost` PendSV's queue was full, and it is gone.
  bool takeEvent(bool isLost = false) {
    _event = uart().takeReceiveEvent() || _event;
    const bool event = _event && !_isCalling;
    _event = _event && _isCalling && !isLost;
    return event && !isLost;
  }
  void call() {
    _isCalling = true;
    _callback.call();
    _isCalling = false;
  }
  void callBack() {
    while (takeEvent()) {
      call();
    }
  }

  stm32l0_uart_t &state() { return uart().state(); }

 private:
  Callback _callback;
  bool _event = false;
  bool _isCalling = false;
};
// By this the library knows the core's state of the port.
inline stm32l0_uart_t *uartOf(CallingPort &port) { return &port.state(); }

// Another port that calls back: the core's state of it is not known.
class UnknownCallingPort : public CallingPort {
 public:
  using CallingPort::CallingPort;
};
inline stm32l0_uart_t *uartOf(UnknownCallingPort &) { return nullptr; }
