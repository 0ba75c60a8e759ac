// Curves of a flight of any length, in bounded memory: the lowest and the highest value of each stretch of time.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace line {

class Curves {
 public:
  static constexpr size_t Channels = 4;  // CH1..CH4

  struct Bucket {
    uint64_t us;
    std::array<uint16_t, Channels> least;
    std::array<uint16_t, Channels> most;
    bool joined;  // to the previous one
  };

  // Takes the values of a frame. `joined`: the line was not silent before it.
  void put(uint64_t us, const uint16_t *channels, bool joined) {
    const bool isNew = _buckets.empty() || !joined || us / _bucketUs != _buckets.back().us / _bucketUs;
    if (isNew) {
      if (_buckets.size() == MostBuckets) {
        halve();
      }
      Bucket bucket = {us, {}, {}, joined && !_buckets.empty()};
      std::copy_n(channels, Channels, bucket.least.begin());
      bucket.most = bucket.least;
      _buckets.push_back(bucket);
      return;
    }
    for (size_t i = 0; i < Channels; i++) {
      _buckets.back().least[i] = std::min(_buckets.back().least[i], channels[i]);
      _buckets.back().most[i] = std::max(_buckets.back().most[i], channels[i]);
    }
  }

  const std::vector<Bucket> &buckets() const { return _buckets; }

 private:
  static constexpr size_t MostBuckets = 2048;

  // Makes room: afterwards at most about half of the buckets are in use. Silences split curves; if there are too many
  // of them, short ones are closed.
  void halve() {
    while ((_buckets.back().us - _buckets.front().us) / _bucketUs >= MostBuckets / 2) {
      _bucketUs *= 2;
    }
    join(true);
    if (_buckets.size() > MostBuckets / 4 * 3) {
      join(false);
    }
  }
  void join(bool keepsSilences) {
    size_t kept = 0;
    for (const Bucket &bucket : _buckets) {
      Bucket *const last = kept == 0 ? nullptr : &_buckets[kept - 1];
      if (last == nullptr || bucket.us / _bucketUs != last->us / _bucketUs || (keepsSilences && !bucket.joined)) {
        _buckets[kept++] = bucket;
        continue;
      }
      for (size_t i = 0; i < Channels; i++) {
        last->least[i] = std::min(last->least[i], bucket.least[i]);
        last->most[i] = std::max(last->most[i], bucket.most[i]);
      }
    }
    _buckets.resize(kept);
  }

  std::vector<Bucket> _buckets;
  uint64_t _bucketUs = 1;
};

}  // namespace line
