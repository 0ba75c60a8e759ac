/// @file
/// What a Diagnosis needs to know beside the counters, from the bytes of a FrameFinder.
#pragma once

#include "FlagRhythm.h"
#include "FrameFinder.h"
#include "OtherProtocols.h"
#include "PacketShape.h"

namespace sbus {

/// The events of a FrameFinder that looks for what is wrong with a line: 180 bytes of RAM. The context that reads the
/// port calls them.
class Symptoms : public NoEvents {
 public:
  /// Returns Trial::other.
  Finding found() const {
    return _protocols.found() != Finding::NoSignal ? _protocols.found()
           : _packets.found() != Finding::NoSignal ? _packets.found()
           : _rhythm.isSteady()                    ? Finding::LostInTurn
                                                   : Finding::NoSignal;
  }

  /// Returns Trial::pulseless.
  uint32_t pulseless() const { return _pulseless; }

  // The events of a FrameFinder.
  void begin() { *this = Symptoms(); }                                   ///< see NoEvents
  void accepted(const uint8_t *frame);                                   ///< see NoEvents
  void extra(const uint8_t *frame, uint32_t) { put(frame, FrameSize); }  ///< see NoEvents
  void discarded(const uint8_t *bytes, int count);                       ///< see NoEvents
  void lost() { _packets.spoil(); }                                      ///< see NoEvents
  void gap(int filled);                                                  ///< see NoEvents

 private:
  static constexpr uint8_t GapsMax = 8;

  void put(const uint8_t *bytes, int count);

  OtherProtocols _protocols;
  PacketShape _packets;
  FlagRhythm _rhythm;
  uint32_t _pulseless = 0;
  uint8_t _gaps[GapsMax] = {};  // how many bytes before each gap are still to come, the next gap first
  uint8_t _gapCount = 0;
};

}  // namespace sbus
