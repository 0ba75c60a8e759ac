// What a decoder makes of a line, for a person to look at: in a terminal, in a browser, in a report. It asks neither
// for the time nor for a file, and compiles to WebAssembly.
//
//   line::Observer observer;
//   observer.listen([&observer](const line::Stretch &stretch) { ... });  // each frame, and what lies between
//   observer.put(character);                                             // as it comes
//   observer.idleUntil(nowUs);                                           // now and then: each time the page is drawn
//   observer.newest().channels, observer.state(nowUs), observer.counters(), ...
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "Line.h"
#include "sbus/FrameFinder.h"
#include "sbus/Link.h"

namespace line {

// A piece of the line. All of them together are the line, each character once and in its order.
struct Stretch {
  enum class Kind { Frame, Frame24, Extra, NoFrame };  // Extra: a frame with header 2F

  Kind kind = Kind::NoFrame;
  std::vector<Character> characters;  // 1 or more; bad ones, too, which no frame is made of
  // Of NoFrame: headers refused in it, by cause, as in sbus::Counters.
  uint32_t refusedByEnd = 0;
  uint32_t refusedByFlags = 0;
  uint32_t refusedByExtra = 0;

  bool isFrame() const { return kind != Kind::NoFrame; }
  uint64_t endUs() const { return characters.back().endUs; }
};

// Why a stretch is no frame: "1 bad character, no end byte", "no header"; empty if it is one.
std::string why(const Stretch &stretch);

// The newest values. All 0 before the first frame.
struct Values {
  uint64_t endUs = 0;              // when the frame was complete
  unsigned count = 0;              // 16 or 24; 32 once frames with header 2F have come
  std::array<uint16_t, 32> raw{};  // CH1.., 0..2047
  std::array<bool, 2> switches{};  // CH17 and CH18 of a line of 16 channels
  bool lostFrame = false;          // the frame's flag
  bool failsafe = false;           // the same
};

// The least and the most of something since reset() or resetMarks().
struct Extent {
  uint64_t count = 0;  // of values; without one the others are 0
  uint64_t low = 0;
  uint64_t high = 0;
  uint64_t sum = 0;

  void add(uint64_t value);
  uint64_t mean() const { return count == 0 ? 0 : (sum + count / 2) / count; }
};

// It hands the characters over as most ports do: 16 at once, or as many as there are when the line falls idle or a
// character is bad. Two decoders get them, one for 16 channels and one for 24; the one that finds more frames is right.
class Observer {
 public:
  using Listener = std::function<void(const Stretch &)>;

  // Called with each stretch as soon as it is certain what it is; newest() is that frame then. Until a decoder is past
  // them, up to two frames' bytes wait: finish() lets them go.
  void listen(Listener listener) { _listener = std::move(listener); }

  // Begins anew on a line whose characters take so long.
  void reset(uint64_t nowUs, uint32_t characterUs);

  // The next character, the oldest first.
  void put(const Character &character);

  // The same of a port that tells no more than what one read has brought, now or up to 20 ms ago, as a browser's does.
  // No shorter pause is believed then: of 6666 frames that came 1 ms late and less, 5964 were found by the times of
  // their characters, all without.
  void putBurst(const uint8_t *bytes, size_t count, uint64_t nowUs);

  // Nothing else has come up to now.
  void idleUntil(uint64_t nowUs);

  // Nothing more will come: what still waits is no frame.
  void finish();

  unsigned long characters() const { return _characters; }
  unsigned long badCharacters() const { return _badCharacters; }
  // True if frames have 24 channels, not 16.
  bool has24() const { return _side24.finder.counters().frames > _side16.finder.counters().frames; }
  const sbus::Counters &counters() const { return has24() ? _side24.finder.counters() : _side16.finder.counters(); }

  // Of the decoder for 16 channels, even if it is not the one that is right: for sbus::Diagnosis.
  const sbus::Counters &counters16() const { return _side16.finder.counters(); }

  const Values &newest() const { return _newest; }
  sbus::LinkState state(uint64_t nowUs);
  // Since the newest frame was complete, in us. Of no meaning while state() is NeverSeen.
  uint64_t ageUs(uint64_t nowUs) const { return nowUs > _newest.endUs ? nowUs - _newest.endUs : 0; }
  // Frames that were complete within the last second.
  unsigned framesPerSecond(uint64_t nowUs) const;

  // us from the end of a frame to the end of the next.
  const Extent &gaps() const { return _gaps; }
  // The travel of a channel, counted from 0: of frames without a flag, since a failsafe setting is nobody's stick.
  const Extent &travel(size_t channel) const { return _travel[channel]; }
  void resetMarks();

 private:
  // Headers refused at good byte `at` or a little after it.
  struct Refusal {
    uint64_t at;
    uint32_t byEnd;
    uint32_t byFlags;
    uint32_t byExtra;
  };

  // A decoder, and how far in the good bytes it has come.
  template <typename Format>
  struct Side {
    sbus::FrameFinderOf<Format> finder;
    uint64_t passed = 0;
    std::deque<Refusal> refusals;
  };

  void resetFinders(uint64_t nowUs, uint32_t characterUs);
  void handOver(uint64_t nowUs);
  template <typename Format>
  void feed(Side<Format> &side, const uint8_t *bytes, size_t count, uint64_t nowUs);
  template <typename Format>
  void found(Side<Format> &side, const sbus::Counters &before, const uint8_t *frame);
  template <typename Format>
  void take(const uint8_t *frame, uint64_t endUs);
  uint64_t passed() const;
  size_t keptThrough(uint64_t good) const;
  size_t keptBefore(uint64_t good) const;
  bool isWhole(uint64_t begin, uint64_t end) const;
  void cut(uint64_t begin, uint64_t end, Stretch::Kind kind);
  void cutNoFrames(size_t count, uint64_t nowUs, bool all);
  void say(Stretch::Kind kind, size_t count);

  Listener _listener;
  std::array<uint8_t, 16> _burst{};
  size_t _waiting = 0;  // bytes of it
  Side<sbus::Frame16> _side16;
  Side<sbus::Frame24> _side24;
  sbus::Link _link;

  std::deque<Character> _kept;  // no stretch yet
  uint64_t _cut = 0;            // good bytes before them
  uint32_t _characterUs = CharacterUs;
  uint64_t _lastEndUs = 0;
  uint64_t _lastBurstUs = 0;
  uint64_t _burstClockUs = 0;  // what the decoders are told
  unsigned long _characters = 0;
  unsigned long _badCharacters = 0;

  Values _newest;
  std::deque<uint64_t> _frameEndsUs;  // of a second
  Extent _gaps;
  std::array<Extent, 32> _travel{};
};

}  // namespace line
