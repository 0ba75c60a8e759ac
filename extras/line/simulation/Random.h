// Random numbers that are the same on every machine: splitmix64 (S. Vigna, public domain).
#pragma once

#include <cstdint>

namespace line {

class Random {
 public:
  explicit Random(uint64_t seed) : _state(seed) {}

  uint64_t next() {
    _state += 0x9E3779B97F4A7C15u;
    uint64_t mixed = _state;
    mixed = (mixed ^ mixed >> 30) * 0xBF58476D1CE4E5B9u;
    mixed = (mixed ^ mixed >> 27) * 0x94D049BB133111EBu;
    return mixed ^ mixed >> 31;
  }

  // Returns a number from 0 to limit - 1.
  uint32_t below(uint32_t limit) { return static_cast<uint32_t>(next() % limit); }
  uint8_t byte() { return static_cast<uint8_t>(next() >> 56); }
  bool chance(double probability) {
    return probability > 0 && static_cast<double>(next() >> 11) < probability * 9007199254740992.0;  // 2^53
  }

 private:
  uint64_t _state;
};

}  // namespace line
