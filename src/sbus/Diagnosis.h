/// @file
/// What is wrong with a line? Judges it from what came with each setting of the port that was tried.
///
///   sbus::Diagnosis diagnosis;                      // a round: each setting is tried once
///   diagnosis.add({100000, true, 500, counters});   // the setting that is meant comes first
///   diagnosis.add({100000, false, 500, counters});
///   text(diagnosis.finding()), remedy(diagnosis.finding())
///   diagnosis.begin();                              // the next round
#pragma once

#include <stdint.h>

#include "Counters.h"

namespace sbus {

/// What was tried, and what came to a DecodeSBus. All trials of a round last equally long.
struct Trial {
  unsigned long baud;  ///< of the port
  bool inverted;       ///< the port inverts
  uint32_t ms;         ///< that the port was polled; half a second has 12 frames of the slowest receiver known (25 Hz)
  Counters counters;   ///< since the port was opened so
};

/// What is wrong. Of several faults the one to be cured first.
enum class Finding : uint8_t {
  NoSignal,              ///< not a byte, with any setting
  NoFrames,              ///< bytes, but with no setting a frame every PeriodMax
  Channels24,            ///< the same, but frames of 24 channels come: they want a DecodeSBus24
  WrongPolarity,         ///< frames come, but with the other inversion than the one that is meant
  WrongBaud,             ///< the same of the baud rate
  WrongPolarityAndBaud,  ///< of both
  PolledTooSeldom,       ///< the port's buffer ran over
  Noise,                 ///< frames are damaged, more than one in a hundred
  Failsafe,              ///< the receiver has given the link up
  NoRadio,               ///< more than half of the frames are lost ones, without failsafe
  Lossy,                 ///< more than a tenth
  AllWellAndMore,        ///< more than a byte a frame belongs to none, and nothing is damaged
  AllWell,
};

/// The finding in words: ASCII, a line of 100 characters at most. On an AVR all words take 1.3 KB of RAM in a sketch
/// that calls this or remedy(), and nothing in others.
const char *text(Finding finding);

/// What to do about it, in words of the same variant.
const char *remedy(Finding finding);

/// About how many frames came damaged. Refused headers do not tell, as each 0F of a impaired frame may be one; but its
/// bytes are skipped. FASSTest 26: those with header 2F, too. 0 if no gap was survived.
uint32_t impairedFrames(const Counters &counters);

/// One round of trials. All calls from one context.
class Diagnosis {
 public:
  static constexpr uint32_t PeriodMax = 100;  ///< ms from frame to frame, on average; a wrong setting makes hardly any

  /// A new round: what was seen in the one before says nothing any more.
  void begin() { *this = Diagnosis(); }

  /// The next trial of the round.
  void add(const Trial &trial);

  /// What is wrong, as far as the trials of this round tell; NoSignal before the first. Fewer than 25 bytes that begin
  /// with 0F may be the beginning of a frame: if nothing else came, they pass for NoSignal.
  Finding finding() const;

  /// The trial with the most frames, of either size, counted from 0; 0 if none has any, and before the first.
  uint8_t best() const { return _best; }

  /// What came in that trial.
  const Counters &seen() const { return _trial.counters; }

 private:
  Trial _trial = Trial();  // the best one
  unsigned long _meantBaud = 0;
  bool _meantInverted = false;
  bool _anyByte = false;
  uint8_t _best = 0;
  uint8_t _count = 0;
};

}  // namespace sbus
