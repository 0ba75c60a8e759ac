// One of Serial1, Serial2 and Serial3: the UART, its settings, and the line at its RX pin, if any.
#pragma once

#include <functional>
#include <vector>

#include "BoardUart.h"
#include "PortSettings.h"
#include "Sender.h"
#include "line/Line.h"
#include "line/LineSettings.h"
#include "line/Observer.h"
#include "line/uart/UartSampler.h"

namespace host {

// Counts the characters received with one combination of the wire's and the port's settings.
struct Reception {
  PortSettings settings;
  line::LineSettings wire;
  unsigned long sent = 0;
  unsigned long good = 0;
  unsigned long bad = 0;  // a wrong parity or stop bit, as the port saw it
};

class BoardPort {
 public:
  void attach(line::Line &line, const line::LineSettings &wire);

  // Takes new settings for the line's other end.
  void rewire(uint64_t nowUs, const line::LineSettings &wire);

  // Like Uart::begin(), end() and onReceive(), but do not wait until the transmit buffer has been sent. Without a
  // `buffer` the port has the board's 64 bytes.
  void open(uint64_t nowUs, const PortSettings &settings, uint8_t *buffer = nullptr, size_t size = 0);
  void close();
  // `listener` tells whose callback it is; null if nothing is to be called.
  void onReceive(std::function<void()> callback, const void *listener);

  // Returns false until a line is attached or the sketch opens the port: until then nothing can happen.
  bool isUsed() const { return _line != nullptr || _everOpened; }

  // Receives the line's characters up to `nowUs`.
  void receive(uint64_t nowUs);

  // Returns when it may next hand bytes over, if no character begins before.
  uint64_t nextUs(uint64_t nowUs);

  // Passes a character to the line, if TX shares its wire.
  void shareWire(const line::Character &character);

  // Calls the sketch's onReceive() callback if bytes have been handed over since the last call.
  void callBack();

  BoardUart &uart() { return _uart; }
  const BoardUart &uart() const { return _uart; }
  Sender &sender() { return _sender; }
  BoardTransmitter &transmitter() { return _sender.transmitter(); }

  const PortSettings &settings() const { return _settings; }  // from the last open()

  // For the report.
  line::Observer &observer() { return _observer; }
  const std::vector<Reception> &receptions() const { return _receptions; }  // one for each combination of settings
  bool everOpened() const { return _everOpened; }
  unsigned long missedClosed() const { return _missedClosed; }  // characters while the port was closed
  bool changedListener() const { return _changedListener; }     // onReceive() replaced a callback of another listener

 private:
  void listen(uint64_t nowUs);
  bool hasBegun(uint64_t nowUs);
  void take(const line::Character &character);

  line::Line *_line = nullptr;
  line::LineSettings _wire;
  line::Character _begun;  // if _hasBegun
  bool _hasBegun = false;
  PortSettings _settings;
  BoardUart _uart;
  Sender _sender;
  line::Observer _observer;
  line::UartSampler _sampler;
  bool _agrees = false;  // port and wire have the same settings: no sampling is needed
  bool _everOpened = false;
  std::vector<Reception> _receptions;
  size_t _reception = 0;  // the one with the current settings
  std::function<void()> _callback;
  const void *_listener = nullptr;  // whose it is
  bool _changedListener = false;
  unsigned long _missedClosed = 0;
};

}  // namespace host
