// What a decoder makes of a line, for a person to look at: in a terminal, in a browser, in a report. It asks neither
// for the time nor for a file, and compiles to WebAssembly.
//
//   line::Observer observer;
//   observer.listen([&observer](const line::Stretch &stretch) { ... });  // each frame, and what lies between
//   observer.put(character);                                             // as it comes
//   observer.idleUntil(nowUs);                                           // now and then: each time the page is drawn
//   observer.newest().channels, observer.state(nowUs), observer.counters(), ...
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <utility>

#include "line/Decoders.h"
#include "line/Segments.h"
#include "line/Statistics.h"
#include "line/telemetry/TelemetrySlots.h"

namespace line {

class Observer : public Statistics {
 public:
  using Listener = std::function<void(const Stretch &)>;

  Observer() { reset(0, CharacterUs); }

  // Called with each stretch as soon as it is certain what it is; newest() is that frame then. Until a decoder is past
  // them, up to two frames' bytes wait: finish() lets them go.
  void listen(Listener listener) { _listener = std::move(listener); }

  // Starts over on a line whose characters take so long.
  void reset(uint64_t nowUs, uint32_t characterUs);

  // The next character, the oldest first. A gap of eight characters before it is seen, less what it may be late. The
  // decoders get it as ports hand it over: with the next one, or when the line has been idle for a character.
  void put(const Character &character);

  // No other character was through by then.
  void idleUntil(uint64_t nowUs);

  // Nothing more will come: what still waits is no frame.
  void finish();

  unsigned long characters() const { return static_cast<unsigned long>(_segments.end()); }
  unsigned long badCharacters() const { return _badCharacters; }
  // True if frames have 24 channels, not 16.
  bool has24() const { return _decoders.has24(); }
  // Returns how many bytes belong neither to a frame nor to telemetry.
  unsigned long discardedBytes() const;
  // As the decoder has them that is right; and the frame with header 2F that the line was joined at is one.
  sbus::Counters counters() const;

  // Returns the telemetry between the frames. Within a listener its proved() are those of this stretch.
  const TelemetrySlots &telemetry() const { return _telemetry; }

  // Of the decoder for 16 channels, even if it is not the one that is right: for sbus::Diagnosis.
  sbus::Counters counters16() const { return _decoders.counters16(); }

 private:
  void handOver();
  void take(Stretch &stretch);
  void say(Stretch &stretch);
  bool isExtraAlone(const Stretch &stretch) const;

  Listener _listener;
  Decoders _decoders;
  TelemetrySlots _telemetry;
  Segments _segments{[this](Stretch &stretch) { take(stretch); }};
  uint32_t _characterUs;
  Character _last;
  uint64_t _lineUs;     // the decoders' time at its end: characters and what is certain to be silence, no more
  uint64_t _silenceUs;  // what is certain since then
  bool _waits;          // the last one has not been handed over
  unsigned long _badCharacters;
  uint64_t _saidUs;               // the end of the last stretch
  std::optional<Stretch> _first;  // may be the frame with header 2F that comes before the first frame
  bool _joinedAtExtra;            // it was
};

}  // namespace line
