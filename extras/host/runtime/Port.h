// One of Serial1, Serial2, Serial3: the UART, what the sketch has set it to, and the line at its RX pin, if any.
#pragma once

#include "BoardUart.h"
#include "Line.h"
#include "LineMonitor.h"
#include "PortSettings.h"

namespace host {

class Port {
 public:
  void attach(Line &line) { _line = &line; }

  // What Uart::begin(), end() and onReceive() do. Without a `buffer` the port has the board's 64 bytes.
  void open(uint64_t nowUs, const PortSettings &settings, uint8_t *buffer = nullptr, size_t size = 0);
  void close() { _uart.close(); }
  void onReceive(void (*callback)()) { _callback = callback; }

  // Takes in what has come over the line by `nowUs`.
  void receive(uint64_t nowUs);

  // Calls the sketch's onReceive() callback if bytes have been handed over since.
  void callBack();

  BoardUart &uart() { return _uart; }
  const BoardUart &uart() const { return _uart; }

  // For the report.
  bool lineInverted() const { return _line != nullptr && _line->inverted(); }
  const LineMonitor &monitor() const { return _monitor; }
  const PortSettings &settings() const { return _settings; }  // of the last open()
  bool everOpened() const { return _everOpened; }
  unsigned long missedClosed() const { return _missedClosed; }      // characters that found the port closed
  unsigned long missedSettings() const { return _missedSettings; }  // characters that found it set to something else

 private:
  Line *_line = nullptr;
  BoardUart _uart;
  LineMonitor _monitor;
  PortSettings _settings;
  void (*_callback)() = nullptr;
  bool _everOpened = false;
  unsigned long _missedClosed = 0;
  unsigned long _missedSettings = 0;
};

}  // namespace host
