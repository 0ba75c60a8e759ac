// A line at the RX pin of USART1: what a sketch knows as Serial1. In front of the pin there is an inverter.
#pragma once

#include <cstdint>
#include <deque>
#include <string>

#include "Mega.h"
#include "line/Line.h"
#include "line/UartSampler.h"
#include "line/LineSettings.h"

namespace mega {

// The line's time 0, at which the host's program starts, comes so much behind the start of the sketch's clock. So both
// see the same frames whenever they print. They print every 200 ms, and T = 9 ms, so some prints fall on a frame's end
// (8 ms + 9 ms n), and some 1 ms behind it:
//   the host   prints 0.00 to 0.06 ms behind a multiple of 200 ms, and finds a frame 0.12 ms behind its end: it misses
//              the frame that ends just then, and sees the one that ended 1 ms ago.
//   the Mega   prints up to 0.96 ms behind it, in steps of 0.064 ms, as its millis() goes on every 1.024 ms only. In
//              15 s those prints that must miss a frame are late by 0.96 ms at the most, those that must see one by
//              0.128 ms at least: so the line has to be late by 0.96 to 1.128 ms, less a pass of loop(). 0.97 to 1.04
//              ms do for all examples but Servos and Mixer, whose passes take 0.3 ms and of different length.
constexpr uint32_t PhaseUs = 1000;

class LineInput {
 public:
  // A wire is late by nothing.
  LineInput(Mega &mega, line::Line &line, uint32_t phaseUs);
  LineInput(const LineInput &) = delete;  // libsimavr has been given its address
  LineInput &operator=(const LineInput &) = delete;

  // The line's time: it is 0 when the host's program starts.
  uint64_t nowUs() const { return toUs(_mega.avr()->cycle); }
  uint64_t toUs(avr_cycle_count_t cycle) const;
  avr_cycle_count_t toCycle(uint64_t us) const;

  // The line had nothing more, and now it has: a wire on which something was sent.
  void look();

  // From now on the other end of the line sends in another way.
  void rewire(const line::LineSettings &wire);

  // What has gone over the line since the port was first opened. A frame is the first 25 characters behind a pause, if
  // all are good.
  unsigned long characters() const { return _characters; }
  unsigned long badCharacters() const { return _badCharacters; }
  unsigned long frames() const { return _frames; }

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
  const uint32_t _phaseUs;
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
  unsigned _run = 0;     // characters behind the last pause
  bool _runBad = false;  // there was a bad one among them
  uint64_t _runBeganUs = 0;
};

}  // namespace mega
