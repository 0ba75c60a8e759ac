// Decodes a line for a person to look at: in a terminal, in a browser, in a report. It uses neither the clock nor
// files, and compiles to WebAssembly.
//
//   line::Observer observer;
//   observer.listen([&observer](const line::Stretch &stretch) { ... });  // each frame, and the bytes between them
//   observer.put(character);                                             // as it arrives
//   observer.idleUntil(nowUs);                                           // now and then: each time the page is drawn
//   observer.newest().channels, observer.state(nowUs), observer.counters(), ...
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "line/Decoders.h"
#include "line/ReadAtBaud.h"
#include "line/Segments.h"
#include "line/SenderFaults.h"
#include "line/Statistics.h"
#include "line/telemetry/TelemetrySlots.h"
#include "sbus/FlagRhythm.h"
#include "sbus/LinkQuality.h"
#include "sbus/OtherProtocols.h"
#include "sbus/PacketShape.h"

namespace line {

class Observer : public Statistics {
 public:
  using Listener = std::function<void(const Stretch &)>;

  Observer() { reset(0, CharacterUs); }

  // Sets the listener, which gets each stretch as soon as its kind is certain; a frame is then newest(). Up to two
  // frames' bytes wait until a decoder is past them, or until finish().
  void listen(Listener listener) { _listener = std::move(listener); }

  // Starts over on a line with characters of `characterUs`.
  void reset(uint64_t nowUs, uint32_t characterUs);

  // Takes the next character, oldest first. A gap before it is detected if it is eight characters longer than the
  // character's `lateUs`. The decoders get the character with the next one, or with idleUntil().
  void put(const Character &character);

  // Takes the time up to which no other character was complete. In sync, a frame is complete with its last character.
  void idleUntil(uint64_t nowUs);

  // Takes the end of the line: the rest is not a frame.
  void finish();

  unsigned long characters() const { return static_cast<unsigned long>(_segments.end()); }
  // Returns the protocol of packets that came before the first frame of S.Bus; NoSignal without one. See
  // sbus::OtherProtocols.
  sbus::Finding otherProtocol() const { return _protocols.found(); }
  // Returns what is wrong with the sender of characters with parity; NoSignal if nothing is. See SenderFaults,
  // PacketShape and FlagRhythm.
  sbus::Finding senderFault() const;
  // Returns "Packets: 24 bytes from 0F to 00, one every 9.0 ms; a frame has 25 bytes."; empty if there are none of one
  // length that are not frames.
  std::string packets() const;

  // Returns the baud rate at which a port seems to have read the line; 0 if it is the line's, or another.
  unsigned long readAtBaud() const { return _readAt.baud(); }

  unsigned long characterErrors() const { return _characterErrors; }
  // Returns "1 frame", "20 frames of 24 channels", or of a line that changed "30 frames, 20 of 24 channels".
  std::string frames() const;
  // Returns true if frames have 24 channels, not 16: the newest ones.
  bool has24() const { return _decoders.has24(); }
  // Returns sbus::LinkQuality of the last second, 0..100.
  unsigned linkQuality(uint64_t nowUs);
  // Returns how many bytes belong neither to a frame nor to telemetry.
  unsigned long discardedBytes() const;

  // Returns the telemetry between the frames. Within the listener, its proved() returns the slots of this stretch.
  const TelemetrySlots &telemetry() const { return _telemetry; }

  // Returns the right decoder's counters, plus frames with header 2F at the beginning or after a silence.
  sbus::Counters counters() const;

  // Returns the counters of the decoder for 16 channels, even if the other is the right one: for sbus::Diagnosis. Its
  // otherSizeFrames are the other decoder's frames, also where gaps do not show their size.
  sbus::Counters counters16() const;

 private:
  void handOver();
  void take(Stretch &stretch);
  void emit(Stretch &stretch);
  void emitFirst();
  void takeGap(uint64_t startUs);
  bool isExtraAlone(const Stretch &stretch) const;
  sbus::Counters withJoins(sbus::Counters counters) const;

  Listener _listener;
  Decoders _decoders;
  TelemetrySlots _telemetry;
  Segments _segments{[this](Stretch &stretch) { take(stretch); }};
  uint32_t _characterUs;
  Character _last;
  uint64_t _lineUs;     // the decoders' time at its end: only characters and certain silence count
  uint64_t _silenceUs;  // the certain silence since then
  sbus::OtherProtocols _protocols;
  SenderFaults _faults;
  ReadAtBaud _readAt;
  sbus::PacketShape _packets;
  Extent _packetPeriods;  // us
  uint64_t _packetUs;     // when the newest began
  sbus::FlagRhythm _rhythm;
  bool _waits;  // _last has not been passed to the decoders
  unsigned long _characterErrors;
  sbus::LinkQuality _quality;
  uint8_t _percent;        // the link quality when the newest frame was complete
  uint64_t _emittedUs;     // the end of the last stretch
  Stretch _first;          // may be the frame with header 2F before the first frame; no characters: there is none
  uint32_t _joinsAtExtra;  // how many times _first was such a frame
};

}  // namespace line
