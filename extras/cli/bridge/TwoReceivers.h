// Chooses one of two receivers: the second only while the first has no link.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "line/Statistics.h"

namespace tool {

class TwoReceivers {
 public:
  // Takes a frame of receiver 0 or 1.
  void put(size_t receiver, uint64_t nowUs, const line::Values &values) {
    if (values.failsafe) {
      _goodUs[receiver] = 0;
    } else if (!values.lostFrame) {
      _goodUs[receiver] = nowUs;
    }
    choose(nowUs);
  }

  // Returns true if a frame without a flag came within the last 0.1 s, and no failsafe frame since.
  bool isGood(size_t receiver, uint64_t nowUs) const {
    return _goodUs[receiver] > 0 && nowUs < _goodUs[receiver] + GoodForUs;
  }

  // Returns the receiver chosen at `nowUs`, which may be a little earlier than in the previous call. The choice stays
  // while neither is good.
  size_t choose(uint64_t nowUs) {
    const bool isFirst = isGood(0, nowUs), isSecond = isGood(1, nowUs);
    _firstSinceUs = !isFirst ? 0 : _firstSinceUs == 0 ? nowUs : _firstSinceUs;
    if (_chosen == 0) {
      _chosen = !isFirst && isSecond && nowUs >= GoodForUs ? 1 : 0;  // at the start, wait for the first
    } else if (isFirst && (!isSecond || nowUs >= _firstSinceUs + BackUs)) {
      _chosen = 0;
    }
    return _chosen;
  }

 private:
  static constexpr uint64_t GoodForUs = 100000;
  static constexpr uint64_t BackUs = 1000000;  // the first has been good for so long before it is chosen again

  size_t _chosen = 0;
  std::array<uint64_t, 2> _goodUs{};  // time of the newest frame without a flag; 0: none, or failsafe since
  uint64_t _firstSinceUs = 0;         // the first has been good since then; 0: it is not
};

}  // namespace tool
