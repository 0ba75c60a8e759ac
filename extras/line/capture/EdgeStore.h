// The edges of a capture's wire, in at most 160 MB. An edge takes two or three bytes; an hour of a receiver that sends
// every 9 ms takes 147 MB if all its channels move.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace line {

class EdgeStore {
 public:
  // Keeps edges in at most `bytesMax`, or in one block.
  explicit EdgeStore(size_t bytesMax = BytesMax) : _blocksMax(std::max<size_t>(1, bytesMax / BlockSize)) {}

  // Takes the wire's level from `ns` on. Times never go back. Ignores a level that is not a change, and all levels once
  // the store is full.
  void put(int64_t ns, bool high);

  // Returns false if some edges did not fit.
  bool isWhole() const { return _isWhole; }
  // Returns the time of the newest stored edge; 0 before the first.
  int64_t endNs() const { return _blocks.empty() ? 0 : _blocks.back()->lastNs; }

  // Calls edge(ns, high) for the newest edge before `fromNs`, if any, and then for the edges up to before `toNs`.
  template <typename Edge>
  void each(int64_t fromNs, int64_t toNs, Edge edge) const {
    for (size_t i = blockBefore(fromNs); i < _blocks.size() && _blocks[i]->firstNs < toNs; i++) {
      _blocks[i]->each(fromNs, toNs, afterNs(i), [&](int64_t ns, int64_t, bool high) { edge(ns, high); });
    }
  }

  // Returns the number of edges that each() would visit, or a few more.
  size_t approximateCount(int64_t fromNs, int64_t toNs) const;

  // Writes the wire's levels in each of `count` columns of that time: 1 low, 2 high, 3 both, 0 unknown. For more than
  // ExactBlocks it uses only each block's summary and longest silence.
  void levels(int64_t fromNs, int64_t toNs, uint8_t *columns, size_t count) const;

 private:
  static constexpr size_t BlockSize = 8192;
  static constexpr size_t BytesMax = size_t{160} << 20;
  static constexpr size_t ExactBlocks = 512;
  static constexpr size_t LongestDelta = 10;  // bytes

  struct Block {
    int64_t firstNs = 0;
    int64_t lastNs = 0;
    int64_t quietFromNs = 0;  // the longest time between two edges
    int64_t quietNs = 0;
    bool isQuietHigh = false;
    bool firstHigh = false;
    bool lastHigh = false;
    uint32_t count = 1;
    uint32_t used = 0;
    uint8_t bytes[BlockSize - 48];  // times between edges, seven bits per byte; the highest bit: more bytes follow

    // Calls edge(ns, nextNs, high) for each edge of that time, and for the one before it. `afterNs` ends the last one.
    template <typename Edge>
    void each(int64_t fromNs, int64_t toNs, int64_t afterNs, Edge edge) const {
      const auto take = [&](int64_t ns, int64_t nextNs, bool high) {
        if (nextNs > fromNs && ns < toNs) {
          edge(ns, nextNs, high);
        }
      };
      int64_t ns = firstNs;
      bool high = firstHigh;
      for (uint32_t at = 0; at < used;) {
        uint64_t delta = 0;
        unsigned shift = 0;
        do {
          delta |= static_cast<uint64_t>(bytes[at] & 0x7f) << shift;
          shift += 7;
        } while ((bytes[at++] & 0x80) != 0);
        const int64_t nextNs = ns + static_cast<int64_t>(delta);
        take(ns, nextNs, high);
        ns = nextNs;
        high = !high;
      }
      take(ns, afterNs, high);
    }
  };

  // Returns the first edge of the next block.
  int64_t afterNs(size_t block) const { return block + 1 < _blocks.size() ? _blocks[block + 1]->firstNs : INT64_MAX; }

  // Returns the index of the last block that begins by then; 0 without one.
  size_t blockBefore(int64_t ns) const;

  size_t _blocksMax;
  bool _isWhole = true;
  std::vector<std::unique_ptr<Block>> _blocks;
};

}  // namespace line
