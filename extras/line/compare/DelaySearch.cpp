#include "line/compare/DelaySearch.h"

#include <algorithm>
#include <cstdlib>
#include <optional>

namespace line {

namespace {

constexpr int64_t WidthUs = 20000;    // by which a late port moves an event
constexpr size_t VotesMost = 100000;  // those of a resting stick, which has a value again and again, may be millions

struct Peak {
  int64_t us = 0;  // the median of its votes
  size_t votes = 0;
};

// Returns the delay with the most votes, not counting those within WidthUs of `without`.
Peak peakOf(const std::vector<int64_t> &votes, std::optional<int64_t> without) {
  Peak peak;
  for (size_t begin = 0, end = 0; begin < votes.size(); begin++) {
    while (end < votes.size() && votes[end] <= votes[begin] + WidthUs) {
      end++;
    }
    const int64_t us = votes[begin + (end - begin) / 2];
    if (end - begin > peak.votes && !(without && std::abs(us - *without) <= WidthUs)) {
      peak = {us, end - begin};
    }
  }
  return peak;
}

}  // namespace

void DelaySearch::forgetBefore(size_t side, int64_t us) {
  std::deque<Event> &events = _events[side];
  while (!events.empty() && events.front().us < us) {
    events.pop_front();
  }
}

// Each pair of events that may be the same votes for a delay. Rare ones are the first, since they tell the most.
std::vector<int64_t> DelaySearch::votesOf(const Places &places) {
  std::vector<const Times *> rare;
  for (const auto &[hash, times] : places) {
    rare.push_back(&times);
  }
  const auto pairs = [](const Times *times) { return (*times)[0].size() * (*times)[1].size(); };
  std::sort(rare.begin(), rare.end(), [&](const Times *a, const Times *b) { return pairs(a) < pairs(b); });
  std::vector<int64_t> votes;
  for (const Times *const times : rare) {
    if (votes.size() + pairs(times) > VotesMost) {
      break;
    }
    for (const int64_t one : (*times)[0]) {
      for (const int64_t other : (*times)[1]) {
        votes.push_back(other - one);
      }
    }
  }
  std::sort(votes.begin(), votes.end());
  return votes;
}

DelaySearch::Fit DelaySearch::fit(const Places &places, const std::array<int64_t, 2> &knownUs, int64_t delayUs) const {
  Fit fit{delayUs, 0, SIZE_MAX};
  for (const size_t side : {size_t{0}, size_t{1}}) {
    const int64_t laterUs = side == 0 ? delayUs : -delayUs;
    const int64_t fromUs = _events[1 - side].front().us;
    const auto shared = std::count_if(_events[side].begin(), _events[side].end(), [&](const Event &event) {
      return event.us + laterUs >= fromUs - WidthUs && event.us + laterUs <= knownUs[1 - side];
    });
    fit.of = std::min(fit.of, static_cast<size_t>(shared));
  }
  for (const auto &[hash, times] : places) {
    for (const int64_t us : times[0]) {
      const auto other = std::lower_bound(times[1].begin(), times[1].end(), us + delayUs - WidthUs / 2);
      fit.agreeing += other != times[1].end() && *other <= us + delayUs + WidthUs / 2;
    }
  }
  fit.agreeing = std::min(fit.agreeing, fit.of);
  return fit;
}

DelaySearch::Result DelaySearch::search(const std::array<int64_t, 2> &knownUs) const {
  Places places;
  for (const size_t side : {size_t{0}, size_t{1}}) {
    for (const Event &event : _events[side]) {
      places[event.hash][side].push_back(event.us);
    }
  }
  const std::vector<int64_t> votes = votesOf(places);
  if (votes.empty()) {
    return {};
  }
  const Fit best = fit(places, knownUs, peakOf(votes, std::nullopt).us);
  const Peak second = peakOf(votes, best.delayUs);
  return {best, second.votes > 0 ? fit(places, knownUs, second.us) : Fit()};
}

}  // namespace line
