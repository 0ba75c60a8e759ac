// Statistics of delays in bounded memory: the median from a histogram with widening buckets, the drift from a line
// fitted to all of them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

namespace line {

class Delays {
 public:
  // Takes a delay at `us`.
  void put(int64_t us, int64_t delayUs) {
    _firstUs = _count == 0 ? us : _firstUs;
    _zeroUs = _count == 0 ? delayUs : _zeroUs;
    _leastUs = _count == 0 ? delayUs : std::min(_leastUs, delayUs);
    _mostUs = _count == 0 ? delayUs : std::max(_mostUs, delayUs);
    _count++;
    const double x = static_cast<double>(us - _firstUs) / 1e6, y = static_cast<double>(delayUs - _zeroUs);
    _x += x;
    _y += y;
    _xx += x * x;
    _xy += x * y;
    _buckets[bucketOf(delayUs)]++;
    if (_buckets.size() > BucketsMost) {
      widen();
    }
  }

  unsigned long count() const { return _count; }
  int64_t leastUs() const { return _leastUs; }
  int64_t mostUs() const { return _mostUs; }

  // Returns the median, exact to 0.2 % of the extent.
  int64_t medianUs() const {
    unsigned long before = 0;
    for (const auto &[bucket, count] : _buckets) {
      before += count;
      if (2 * before >= _count) {
        return bucket * _widthUs + _widthUs / 2;
      }
    }
    return 0;
  }

  // Returns the delay at `us` on the fitted line.
  double at(int64_t us) const {
    const auto n = static_cast<double>(std::max(_count, 1UL));
    return static_cast<double>(_zeroUs) + _y / n + driftPpm() * (static_cast<double>(us - _firstUs) / 1e6 - _x / n);
  }

  // Returns the growth of the delay in us per second: the clocks' difference in parts per million.
  double driftPpm() const {
    const auto n = static_cast<double>(_count);
    const double spread = n * _xx - _x * _x;
    return spread > 0 ? (n * _xy - _x * _y) / spread : 0;
  }

 private:
  static constexpr size_t BucketsMost = 1024;

  int64_t bucketOf(int64_t us) const { return us >= 0 ? us / _widthUs : -((-us + _widthUs - 1) / _widthUs); }

  void widen() {
    std::map<int64_t, unsigned long> wider;
    for (const auto &[bucket, count] : std::exchange(_buckets, {})) {
      wider[bucket >= 0 ? bucket / 2 : -((1 - bucket) / 2)] += count;
    }
    _buckets = std::move(wider);
    _widthUs *= 2;
  }

  unsigned long _count = 0;
  int64_t _firstUs = 0;
  int64_t _zeroUs = 0;  // the first delay
  int64_t _leastUs = 0;
  int64_t _mostUs = 0;
  double _x = 0, _y = 0, _xx = 0, _xy = 0;
  std::map<int64_t, unsigned long> _buckets;
  int64_t _widthUs = 1;
};

}  // namespace line
