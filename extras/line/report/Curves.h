// Curves of a flight of any length, in bounded memory: the lowest and the highest value of each stretch of time.
#pragma once

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
  void put(uint64_t us, const uint16_t *channels, bool joined);

  const std::vector<Bucket> &buckets() const { return _buckets; }

 private:
  static constexpr size_t MostBuckets = 2048;

  void halve();
  void join(bool keepsSilences);

  std::vector<Bucket> _buckets;
  uint64_t _bucketUs = 1;
};

}  // namespace line
