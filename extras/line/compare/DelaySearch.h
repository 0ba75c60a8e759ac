// Searches for the delay between two lines: that at which most of what happens on one also happens on the other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <unordered_map>
#include <vector>

namespace line {

class DelaySearch {
 public:
  // How well a delay of the second line explains the events.
  struct Fit {
    int64_t delayUs = 0;
    size_t agreeing = 0;  // events that happen on both
    size_t of = 0;        // those at times that both have

    // Returns true if chance does not explain it.
    bool isLikely() const { return agreeing >= Least && 2 * agreeing > of; }
  };
  struct Result {
    Fit best;
    Fit second;  // the best one elsewhere

    // Returns true if the events hardly repeat themselves.
    bool isCertain() const { return best.isLikely() && 2 * second.agreeing <= best.agreeing; }
    // Returns true if they do not at all: more of them would not change the delay.
    bool isFinal() const { return isCertain() && !second.isLikely(); }
  };

  // Takes an event of a side, 0 or 1; events that may be the same have one `hash`.
  void put(size_t side, int64_t us, uint64_t hash) { _events[side].push_back({us, hash}); }

  // Forgets a side's events before this time, in its own clock.
  void forgetBefore(size_t side, int64_t us);

  void clear() { _events = {}; }

  // `knownUs`: up to when each side is known.
  Result search(const std::array<int64_t, 2> &knownUs) const;

 private:
  static constexpr size_t Least = 8;

  struct Event {
    int64_t us;
    uint64_t hash;
  };
  // The times of the events with one hash.
  using Times = std::array<std::vector<int64_t>, 2>;
  using Places = std::unordered_map<uint64_t, Times>;

  static std::vector<int64_t> votesOf(const Places &places);
  Fit fit(const Places &places, const std::array<int64_t, 2> &knownUs, int64_t delayUs) const;

  std::array<std::deque<Event>, 2> _events;
};

}  // namespace line
