#include "line/report/Curves.h"

#include <algorithm>

namespace line {

void Curves::put(uint64_t us, const uint16_t *channels, bool joined) {
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

// Joins buckets until half of the room is free. Silences, which part curves, can be more than that: then short ones
// close.
void Curves::halve() {
  for (bool keepsSilences = true; _buckets.size() > MostBuckets / 2;) {
    const size_t before = _buckets.size();
    _bucketUs *= 2;
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
    keepsSilences = kept < before;
  }
}

}  // namespace line
