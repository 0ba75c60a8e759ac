// Matches the frames of two sources by their contents. It keeps a few seconds; while all frames are alike, ten minutes
// at most.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "line/FrameRate.h"
#include "line/Statistics.h"
#include "line/compare/DelaySearch.h"
#include "sbus/Frame.h"

namespace line {

// What told the delay. Times: nothing; the clocks were assumed to agree.
enum class DelayBy { Times, Contents };

// A finding, at a time of the first source.
struct Alignment {
  enum class Kind { Pair, Only };

  Kind kind;
  size_t side;  // of Only: 0 is the first source
  std::array<std::optional<Values>, 2> values;
  int64_t delayUs;     // of Pair: the second one's delay
  bool isSameContent;  // of Pair: all channels that both have
  bool isLate;         // the PC was late: what it read then came some time before
};

// Returns how many channels both have.
inline std::ptrdiff_t commonChannels(const Values &a, const Values &b) {
  return static_cast<std::ptrdiff_t>(std::min(a.count, b.count));
}

// Returns true if both have the switches CH17 and CH18.
inline bool haveSwitches(const Values &a, const Values &b) {
  return a.count != sbus::ChannelCount24 && b.count != sbus::ChannelCount24;
}

class Aligner {
 public:
  // Calls `onFinding` with each finding in the order of time.
  explicit Aligner(std::function<void(int64_t us, const Alignment &)> onFinding) : _onFinding(std::move(onFinding)) {}

  // Takes the next frame of a side, 0 or 1. It came at most `lateUs` earlier.
  void put(size_t side, int64_t us, const Values &values, int64_t lateUs = 0);

  // Takes the time up to which there are no further frames.
  void knownUntil(size_t side, int64_t us);

  // Takes the end of both sources.
  void finish();

  // Returns what told the delay.
  DelayBy by() const { return _by; }
  // Returns the delay of the second source.
  int64_t delayUs() const { return std::llround(_delayUs); }
  // Returns false if the delay may be wrong.
  bool isCertain() const { return _by != DelayBy::Times && _searched.isCertain(); }
  // Returns FrameRate::perSecond() of a side.
  double perSecond(size_t side) const { return _sides[side].rate.perSecond(); }
  // Returns "the contents: 55 of 57 agree", which counts changes.
  std::string evidence() const;

 private:
  static constexpr int64_t NeverUs = INT64_MIN / 2;

  struct Frame {
    int64_t us;
    bool isChange;  // its channels differ from the previous frame's
    Values values;
    int64_t lateUs;  // it came at most this much earlier
  };
  struct Side {
    std::deque<Frame> frames;  // still to be matched
    std::deque<Frame> unmatched;
    std::deque<Frame> changes;                     // of the last seconds
    std::deque<std::pair<int64_t, int64_t>> late;  // when the PC was late, in the side's times
    int64_t knownUs = NeverUs;
    int64_t newestUs = NeverUs;  // of the newest frame
    FrameRate rate;
  };

  bool isSame(const Values &a, const Values &b) const;
  uint64_t hashOf(const Values &values) const;
  bool isChange(size_t side, int64_t us, const Values &values);
  void setCommon();
  bool isOnly(const Frame &frame) const;
  size_t runOf(const Frame &first, const std::deque<Frame> &frames, size_t next) const;
  void work(bool isEnd);
  bool findDelay(bool isEnd);
  void noteRate(Side &side, int64_t us, int64_t lateUs);
  void checkDelay();
  void match(const Frame &frame);
  bool pairMoved(size_t side);
  void giveUpSecond(int64_t beforeUs);
  void pairUnmatched(int64_t beforeUs);
  bool isLate(int64_t us) const;
  void add(const Frame &a, const Frame &b, bool isSameContent, bool isLate);
  void addOnly(size_t side, int64_t us, const Frame &frame);
  void giveUpOld(size_t side);
  void emitBefore(int64_t us);

  const std::function<void(int64_t us, const Alignment &)> _onFinding;
  std::array<Side, 2> _sides;
  std::array<std::optional<Values>, 2> _newest;
  std::ptrdiff_t _channels = 0;  // that both sides have; before both have a frame, those of one
  bool _hasSwitches = false;     // both sides have
  std::multimap<int64_t, Alignment> _found;
  bool _hasDelay = false;
  DelayBy _by = DelayBy::Times;
  DelaySearch _changes;  // of the last minute
  DelaySearch::Result _searched;
  double _delayUs = 0;  // follows the clocks
  int64_t _periodUs = 9000;
  int64_t _tryUs = NeverUs;  // when to search for the delay again
};

}  // namespace line
