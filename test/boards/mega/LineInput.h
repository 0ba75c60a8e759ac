// A line at the RX pin of USART1: what a sketch knows as Serial1. In front of the pin there is an inverter.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <utility>

#include "Mega.h"
#include "line/Line.h"
#include "line/LineSettings.h"
#include "line/UartSampler.h"
#include "support/BitByBit.h"

namespace mega {

class LineInput {
 public:
  LineInput(Mega &mega, line::Line &line);
  LineInput(const LineInput &) = delete;  // libsimavr has been given its address
  LineInput &operator=(const LineInput &) = delete;

  // Called when a frame has gone over the line: the first 25 characters after a pause, if all are good.
  void onFrame(std::function<void(const Frame &)> callback) { _onFrame = std::move(callback); }

  // The line had nothing more, and now it has: a wire on which something was sent.
  void look();

  // From now on the other end of the line sends in another way.
  void rewire(const line::LineSettings &wire);

  // What has gone over the line since the port was first opened.
  unsigned long characters() const { return _characters; }
  unsigned long badCharacters() const { return _badCharacters; }
  unsigned long frames() const { return _frames; }
  unsigned long others() const { return _characters - _badCharacters - _frames * sbus::FrameSize; }

  // When the last one was through, as the sketch's micros() counts.
  uint64_t lastFrameUs() const { return _lastFrameUs; }

  // The frames that went over it, from their first to their last character, since the port was last opened.
  unsigned long framesSinceOpen() const { return _framesSinceOpen; }

  // What the port lost of it, because the sketch did not fetch it in time.
  unsigned long overruns() const { return _overruns; }

  // In what its settings differed from the line's when characters came: "baud rate, format"; empty if they never did.
  const std::string &wrongSettings() const { return _wrongSettings; }

 private:
  static void controlWritten(avr_irq_t *, uint32_t value, void *input);
  static avr_cycle_count_t characterThrough(avr_t *, avr_cycle_count_t when, void *input);
  static uint8_t statusRead(avr_t *avr, avr_io_addr_t address, void *input);
  static uint8_t dataRead(avr_t *avr, avr_io_addr_t address, void *input);

  avr_cycle_count_t toCycle(uint64_t us) const { return _mega.clockZero() + us * CyclesPerUs; }
  bool fetch();
  void open();
  void settle();
  void count(const line::Character &character);
  void put(const line::Character &character);
  void receive(const line::Character &character);
  void forgetRead();
  void hook(avr_io_addr_t address, avr_io_read_t ours, avr_io_read_t &theirs);

  Mega &_mega;
  avr_uart_t &_usart;
  line::Line &_line;
  std::function<void(const Frame &)> _onFrame;
  line::LineSettings _wire;
  line::UartSampler _sampler;
  line::Character _next;   // on its way,
  bool _isComing = false;  // if there is one

  bool _everOpen = false;
  bool _open = false;
  std::string _mismatch;  // of the present settings
  std::string _wrongSettings;
  uint64_t _openedUs = 0;
  std::deque<bool> _bad;  // of the characters received and not yet read, the oldest first

  avr_io_read_t _readStatus = nullptr;  // libsimavr's own
  avr_io_read_t _readData = nullptr;

  unsigned long _characters = 0;
  unsigned long _badCharacters = 0;
  unsigned long _frames = 0;
  unsigned long _framesSinceOpen = 0;
  unsigned long _overruns = 0;
  uint64_t _lastFrameUs = 0;
  uint64_t _lastEndUs = 0;
  Frame _frame{};
  unsigned _run = 0;     // characters after the last pause
  bool _runBad = false;  // there was a bad one among them
  uint64_t _runBeganUs = 0;
};

}  // namespace mega
