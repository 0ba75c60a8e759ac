/// @file
/// Finds out what is wrong with a line, from what arrived with each port setting that was tried.
///
///   sbus::Diagnosis diagnosis;                      // a round: each setting is tried once
///   diagnosis.add({100000, true, 500, counters, pulseless, other});   // the expected setting first
///   diagnosis.add({100000, false, 500, counters, pulseless, other});
///   text(diagnosis.finding()), remedy(diagnosis.finding())
///   diagnosis.begin();                              // the next round
#pragma once

#include <stdint.h>

#include "Counters.h"
#include "Text.h"

namespace sbus {

/// What is wrong with the line; of several faults, the one to fix first.
enum class Finding : uint8_t {
  NoSignal,              ///< no byte with any setting
  IBus,                  ///< packets of FlySky's i-BUS
  Crsf,                  ///< of TBS's CRSF, which ExpressLRS sends
  FPort,                 ///< of FrSky's F.Port
  Sumd,                  ///< of Graupner's SUMD
  Spektrum,              ///< of a Spektrum satellite
  Dbus,                  ///< of DJI's DBUS
  NoParity,              ///< characters of 8N1 or 8N2
  IdleLevel,             ///< between frames the line has the level of a start bit
  NoFrames,              ///< bytes, but no setting brings a frame every PeriodMax, nor intact ones less often
  WrongPackets,          ///< packets of one length that are not frames
  Channels24,            ///< no frames of 16 channels, but frames of 24, for a DecodeSBus24
  WrongPolarity,         ///< frames come with the opposite polarity
  WrongBaud,             ///< frames come with the other baud rate
  WrongPolarityAndBaud,  ///< frames come with the other polarity and the other baud rate
  PolledTooSeldom,       ///< the port's buffer overflowed
  InterruptsOff,         ///< the port lost bytes while interrupts were off (not noticed on an AVR)
  UnusedFlags,           ///< frames have flags in bits that are not used
  Noise,                 ///< more than one frame in a hundred is impaired
  SevenBits,             ///< not a byte has bit 7: the port has removed it
  NoPulses,              ///< the receiver has lost the radio, and sends 0 without a flag
  Failsafe,              ///< the receiver is in failsafe
  NoRadio,               ///< more than half of the frames have the lost-frame flag, without failsafe
  LostInTurn,            ///< these frames come at a steady rhythm, as the radio's packets
  Lossy,                 ///< more than a tenth of the frames have the lost-frame flag
  LongPeriod,            ///< the frame period is PeriodLong or more
  AllWellAndMore,        ///< no fault; more than a byte per frame belongs to no frame
  AllWell,               ///< no fault
};

/// A setting that was tried, and what a DecodeSBusDiagnosis has counted with it: to a DecodeSBus, frames with header
/// 2F count as impaired. All trials of a round last equally long.
struct Trial {
  unsigned long baud;  ///< of the port
  bool inverted;       ///< the port inverts
  uint32_t ms;         ///< how long the port was polled; in 500 ms the slowest receiver known (25 Hz) sends 12 frames
  Counters counters;   ///< since the port was opened with this setting
  uint32_t pulseless;  ///< frames without a flag for which hasNoPulses() is true
  Finding other;       ///< what the bytes show, IBus to WrongPackets, UnusedFlags, SevenBits, LostInTurn; or NoSignal
};

/// Returns the finding in words, as "Title: a sentence.", in at most 100 ASCII characters.
Text text(Finding finding);

/// Returns what to do about the finding, in at most 100 ASCII characters.
Text remedy(Finding finding);

/// Returns approximately how many frames were impaired, including those with header 2F. It estimates this from the
/// discarded bytes, because each 0F of an impaired frame counts as a rejected header. Returns 0 without a resync.
uint32_t impairedFrames(const Counters &counters);

/// One round of trials. Call all methods from one context.
class Diagnosis {
 public:
  static constexpr uint32_t PeriodMax = 100;  ///< ms, mean frame interval; a wrong setting brings hardly any frame
  static constexpr uint32_t PeriodLong = 50;  ///< ms; with Link's default timeout, a missing frame makes the link stale

  /// Starts a new round, and forgets the one before.
  void begin() { *this = Diagnosis(); }

  /// Takes the next trial of the round.
  void add(const Trial &trial);

  /// Returns what the trials of this round show; NoSignal before the first. Fewer than 25 bytes that begin with
  /// 0F count as NoSignal: they may be the start of a frame.
  Finding finding() const;

  /// Returns the trial with the most frames of either size, counted from 0; 0 if none has any, and before the first.
  uint8_t best() const { return _best; }

  /// Returns the counters of the trial best().
  const Counters &seen() const { return _trial.counters; }

 private:
  Trial _trial = Trial();  // the best one
  unsigned long _meantBaud = 0;
  bool _meantInverted = false;
  bool _anyByte = false;
  Finding _other = Finding::NoSignal;
  uint8_t _best = 0;
  uint8_t _count = 0;
};

}  // namespace sbus
