// Whether a sketch prints, sends and does at its pins what its line says. Each row, pulse and sent frame must come from
// the newest frame on the line, or from the one before: the sketch is busy, or it is not yet certain where a frame
// ends.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "Eeprom.h"
#include "Mega.h"
#include "sbus/Calibration.h"
#include "support/BitByBit.h"

namespace mega {

// A frame of the line, read bit by bit: the library has no part in it.
struct SeenFrame {
  Channels channels;
  Channels held;  // of the newest frame without failsafe
  bool failsafe;
  bool lostFrame;
  unsigned long number;  // 0: no frame has come yet
  unsigned long others;  // undamaged characters before it that belong to no frame
};

using Numbers = std::vector<double>;

// What a sketch makes of a frame; empty: it must not make anything of it. `stale`: no frame came for 100 ms.
using Rule = Numbers (*)(const SeenFrame &frame, bool stale, const sbus::Calibration &calibration);

class Expected {
 public:
  // Nothing is checked of a sketch that is not known here.
  Expected(const std::string &sketch, Mega &mega, Eeprom &eeprom);

  void frame(const Frame &frame, unsigned long others);  // has just gone over the line; see SeenFrame
  void printed(char character);                          // begins to leave Serial
  void sent(uint8_t byte);                               // begins to leave Serial2
  void pulseBegins(unsigned channel);                    // 0..3
  void pulseEnds(unsigned channel, double widthUs);

  // Tells standard error how much was checked, and each mistake. Returns whether there was none.
  bool report() const;

 private:
  using Candidates = std::vector<Numbers>;

  Candidates candidates(Rule rule) const;
  void check(const char *what, const Numbers &found, const Candidates &candidates, double tolerance);
  void checkTime(const char *what, double us, double least, double most);

  Mega &_mega;
  Eeprom &_eeprom;
  Rule _row = nullptr;
  Rule _sending = nullptr;
  bool _hasPulses = false;
  bool _hasWords = false;
  SeenFrame _newest;
  SeenFrame _before;
  uint64_t _newestUs = 0;

  std::string _line;  // printed so far,
  Candidates _rows;   // and what it may be
  Frame _frame{};     // sent so far,
  size_t _frameSize = 0;
  Candidates _frames;  // and what it may be
  Candidates _pulses[4];
  double _firstSentUs = 0;
  double _lastPulseUs = 0;
  unsigned long _rowCount = 0;
  unsigned long _sentCount = 0;
  unsigned long _pulseCounts[4] = {};
  std::vector<std::string> _mistakes;
};

}  // namespace mega
