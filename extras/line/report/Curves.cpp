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

// Makes room: afterwards at most about half of the buckets are in use. Silences split curves; if there are too many of
// them, short ones are closed.
void Curves::halve() {
  while ((_buckets.back().us - _buckets.front().us) / _bucketUs >= MostBuckets / 2) {
    _bucketUs *= 2;
  }
  join(true);
  if (_buckets.size() > MostBuckets / 4 * 3) {
    join(false);
  }
}

void Curves::join(bool keepsSilences) {
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

}  // namespace line
