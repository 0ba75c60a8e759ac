// Chooses one of two receivers: the first one, or the second while the first has no link.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "line/Statistics.h"

namespace tool {

class TwoReceivers {
 public:
  // The first one has to be good for `backUs` without a break before it is chosen again.
  explicit TwoReceivers(uint64_t backUs) : _backUs(backUs) {}

  // Takes a frame of a receiver, 0 or 1.
  void put(size_t receiver, uint64_t nowUs, const line::Values &values) {
    if (values.failsafe) {
      _goodUs[receiver] = 0;
    } else if (!values.lostFrame) {
      _goodUs[receiver] = nowUs;
    }
    choose(nowUs);
  }

  // Returns true if a frame without a flag has come within the last 0.1 s, and none in failsafe since.
  bool isGood(size_t receiver, uint64_t nowUs) const {
    return _goodUs[receiver] > 0 && nowUs < _goodUs[receiver] + GoodForUs;
  }

  // Returns which one is chosen at `nowUs`, which may be somewhat earlier than at the call before. Without a good one
  // it stays the same.
  size_t choose(uint64_t nowUs) {
    const bool isFirst = isGood(0, nowUs), isSecond = isGood(1, nowUs);
    _firstSinceUs = !isFirst ? 0 : _firstSinceUs == 0 ? nowUs : _firstSinceUs;
    if (_chosen == 0) {
      _chosen = !isFirst && isSecond && nowUs >= GoodForUs ? 1 : 0;  // at the start the first has time to come
    } else if (isFirst && (!isSecond || nowUs >= _firstSinceUs + _backUs)) {
      _chosen = 0;
    }
    return _chosen;
  }

 private:
  static constexpr uint64_t GoodForUs = 100000;

  const uint64_t _backUs;
  size_t _chosen = 0;
  std::array<uint64_t, 2> _goodUs{};  // when the newest frame without a flag came; 0: none, or failsafe since
  uint64_t _firstSinceUs = 0;         // since when the first is good; 0: it is not
};

}  // namespace tool
