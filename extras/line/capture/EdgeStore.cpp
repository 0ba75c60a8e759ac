#include "line/capture/EdgeStore.h"

#include <algorithm>

namespace line {

void EdgeStore::put(int64_t ns, bool high) {
  if (!_isWhole || (!_blocks.empty() && _blocks.back()->lastHigh == high)) {
    return;
  }
  if (_blocks.empty() || _blocks.back()->used + LongestDelta > sizeof _blocks.back()->bytes) {
    if (_blocks.size() == _blocksMax) {
      _isWhole = false;
      return;
    }
    auto block = std::make_unique<Block>();
    block->firstNs = block->quietFromNs = ns;
    block->firstHigh = high;
    _blocks.push_back(std::move(block));
  } else {
    Block &block = *_blocks.back();
    auto delta = static_cast<uint64_t>(ns - block.lastNs);
    if (static_cast<int64_t>(delta) > block.quietNs) {
      block.quietFromNs = block.lastNs;
      block.quietNs = static_cast<int64_t>(delta);
      block.isQuietHigh = block.lastHigh;
    }
    for (; delta > 0x7f; delta >>= 7) {
      block.bytes[block.used++] = static_cast<uint8_t>(delta | 0x80);
    }
    block.bytes[block.used++] = static_cast<uint8_t>(delta);
    block.count++;
  }
  _blocks.back()->lastNs = ns;
  _blocks.back()->lastHigh = high;
}

size_t EdgeStore::blockBefore(int64_t ns) const {
  const auto after = std::upper_bound(_blocks.begin(), _blocks.end(), ns,
                                      [](int64_t time, const auto &block) { return time < block->firstNs; });
  return after == _blocks.begin() ? 0 : static_cast<size_t>(after - _blocks.begin()) - 1;
}

size_t EdgeStore::approximateCount(int64_t fromNs, int64_t toNs) const {
  size_t count = 0;
  for (size_t i = blockBefore(fromNs); i < _blocks.size() && _blocks[i]->firstNs < toNs; i++) {
    const Block &block = *_blocks[i];
    if (block.firstNs >= fromNs && block.lastNs < toNs) {
      count += block.count;
    } else {
      block.each(fromNs, toNs, INT64_MAX, [&count](int64_t, int64_t, bool) { count++; });
    }
  }
  return count;
}

void EdgeStore::levels(int64_t fromNs, int64_t toNs, uint8_t *columns, size_t count) const {
  std::fill_n(columns, count, uint8_t{0});
  const double perNs = static_cast<double>(count) / static_cast<double>(toNs - fromNs);
  const auto mark = [&](int64_t beginNs, int64_t endNs, uint8_t mask) {
    if (endNs < fromNs || beginNs >= toNs) {
      return;
    }
    const auto column = [&](int64_t ns) {
      const double place = static_cast<double>(std::clamp(ns, fromNs, toNs) - fromNs) * perNs;
      return std::min(static_cast<size_t>(place), count - 1);
    };
    for (size_t i = column(beginNs), last = column(endNs); i <= last; i++) {
      columns[i] = static_cast<uint8_t>(columns[i] | mask);
    }
  };
  const size_t first = blockBefore(fromNs);
  const bool isExact = blockBefore(toNs) - first <= ExactBlocks;
  for (size_t i = first; i < _blocks.size() && _blocks[i]->firstNs < toNs; i++) {
    const Block &block = *_blocks[i];
    if (isExact) {
      block.each(fromNs, toNs, afterNs(i),
                 [&mark](int64_t ns, int64_t nextNs, bool high) { mark(ns, nextNs, high ? 2 : 1); });
    } else {
      const int64_t quietToNs = block.quietFromNs + block.quietNs;
      mark(block.firstNs, block.quietFromNs, 3);
      mark(block.quietFromNs, quietToNs, block.isQuietHigh ? 2 : 1);
      mark(quietToNs, block.lastNs, 3);
      mark(block.lastNs, afterNs(i), block.lastHigh ? 2 : 1);
    }
  }
}

}  // namespace line
