// One of Serial1, Serial2, Serial3: the UART, what the sketch has set it to, and the line at its RX pin, if any.
#pragma once

#include <vector>

#include "BoardUart.h"
#include "Line.h"
#include "LineMonitor.h"
#include "PortSettings.h"
#include "UartSampler.h"
#include "Wire.h"

namespace host {

// What came of the characters on the wire while the port had certain settings.
struct Reception {
  PortSettings settings;
  unsigned long sent = 0;
  unsigned long good = 0;
  unsigned long bad = 0;  // a wrong parity or stop bit, as the port saw it
};

class Port {
 public:
  void attach(Line &line, const Wire &wire);

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
  LineMonitor &monitor() { return _monitor; }
  const Wire &wire() const { return _wire; }
  const std::vector<Reception> &receptions() const { return _receptions; }  // one for each of the settings used
  bool everOpened() const { return !_receptions.empty(); }
  unsigned long missedClosed() const { return _missedClosed; }  // characters that found the port closed

 private:
  void take(const Character &character);

  Line *_line = nullptr;
  Wire _wire;
  BoardUart _uart;
  LineMonitor _monitor;
  UartSampler _sampler;
  bool _agrees = false;  // the port is set as the wire wants it: then nothing has to be sampled
  std::vector<Reception> _receptions;
  size_t _reception = 0;  // the one with the present settings
  void (*_callback)() = nullptr;
  unsigned long _missedClosed = 0;
};

}  // namespace host
