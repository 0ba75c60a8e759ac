// Matches the frames of two sources by their contents. It keeps a few seconds, a minute at most.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>

#include "line/Statistics.h"

namespace line {

// A finding, at a time of the first source.
struct Alignment {
  enum class Kind { Pair, Only };

  Kind kind;
  size_t side;  // of Only: 0 is the first source
  std::array<std::optional<Values>, 2> values;
  int64_t delayUs;     // of Pair: the second one's delay
  bool isSameContent;  // of Pair: all channels are the same
};

class Aligner {
 public:
  // Calls `onFinding` with each finding in the order of time.
  explicit Aligner(std::function<void(int64_t us, const Alignment &)> onFinding) : _onFinding(std::move(onFinding)) {}

  // Takes the next frame of a side, 0 or 1.
  void put(size_t side, int64_t us, const Values &values);

  // Takes the time up to which there are no further frames.
  void knownUntil(size_t side, int64_t us);

  // Takes the end of both sources.
  void finish();

  // Returns true if the delay was found by contents, false if the clocks were assumed to agree.
  bool isByContents() const { return _isByContents; }

 private:
  static constexpr int64_t NeverUs = INT64_MIN / 2;

  struct Frame {
    int64_t us;
    bool isChange;  // its channels differ from the previous frame's
    Values values;
  };
  struct Side {
    std::deque<Frame> frames;  // still to be matched
    std::deque<Frame> unmatched;
    int64_t knownUs = NeverUs;
  };

  static size_t runOf(const Frame &first, const std::deque<Frame> &frames, size_t next);
  void work(bool isEnd);
  bool findDelay(bool isEnd);
  void findPeriod();
  void match(const Frame &frame);
  void giveUpSecond(int64_t beforeUs);
  void pairUnmatched(int64_t beforeUs);
  void add(const Frame &a, const Frame &b, bool isSameContent);
  void addOnly(size_t side, int64_t us, const Frame &frame);
  void giveUpOld(size_t side);
  void emitBefore(int64_t us);

  const std::function<void(int64_t us, const Alignment &)> _onFinding;
  std::array<Side, 2> _sides;
  std::array<std::optional<Values>, 2> _newest;
  std::multimap<int64_t, Alignment> _found;
  bool _hasDelay = false;
  bool _isByContents = false;
  double _delayUs = 0;  // follows the clocks
  int64_t _periodUs = 9000;
  int64_t _tryUs = NeverUs;  // when to search for the delay again
};

}  // namespace line
