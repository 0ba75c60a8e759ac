// Tells a silence at a port from an adapter, USB or a system that has stalled: after it, what the line sent meanwhile
// comes at once. (line/recording/LateReads.h tells them apart in a recording.)
#pragma once

#include <utility>
#include <vector>

#include "line/Silence.h"

namespace scope {

class StalledReads {
 public:
  // Takes a read that is not empty.
  void put(const uint8_t *bytes, size_t count, uint64_t nowUs) {
    if (_held.empty()) {
      _isStall = false;
      _quietUs = _readUs;
      _heldUs = nowUs;
      if (nowUs >= _readUs + line::SilenceUs) {
        _mayBeStall = std::exchange(_fromUs, 0) > 0 && _paceCount > 0;
      }
    }
    _held.insert(_held.end(), bytes, bytes + count);
    _readUs = nowUs;
    measure(count, nowUs);
  }

  // Returns true while it is not known what the bytes are: more than the line can send come within LongestUs.
  bool waits(uint64_t nowUs) {
    if (!_mayBeStall || _isStall) {
      return false;
    }
    const uint64_t sentUs = _held.size() * _paceUs / _paceCount;
    _isStall = sentUs + (nowUs - _quietUs) / PartInaccurate >= nowUs - _quietUs;
    _mayBeStall = !_isStall && nowUs < _heldUs + LongestUs && sentUs > 2 * (nowUs - _heldUs);
    return _mayBeStall;
  }

  // Returns what it holds, and forgets it.
  std::vector<uint8_t> take() { return std::exchange(_held, {}); }
  bool isHolding() const { return !_held.empty(); }
  // Returns true if what take() returned last was held back from quietUs() on.
  bool isStall() const { return _isStall; }
  uint64_t quietUs() const { return _quietUs; }
  // Returns how often the line sends a byte on average, in us.
  uint64_t stepUs() const { return _paceUs / _paceCount; }

 private:
  // Measures the pace over half a second without a silence.
  void measure(size_t count, uint64_t nowUs) {
    if (_fromUs == 0) {
      _fromUs = nowUs;
      _count = 0;
    } else if ((_count += count, nowUs >= _fromUs + MeasuredUs)) {
      _paceUs = nowUs - std::exchange(_fromUs, nowUs);
      _paceCount = std::exchange(_count, 0);
    }
  }

  static constexpr uint64_t LongestUs = 100000;
  static constexpr uint64_t MeasuredUs = 500000;
  static constexpr unsigned PartInaccurate = 16;  // of the pace

  std::vector<uint8_t> _held;
  bool _mayBeStall = false;
  bool _isStall = false;
  uint64_t _readUs = 0;   // the newest read
  uint64_t _quietUs = 0;  // the one before those that are held
  uint64_t _heldUs = 0;   // the first of these
  uint64_t _fromUs = 0;   // when the measurement began; 0: with the next read
  uint64_t _count = 0;    // bytes since then
  uint64_t _paceUs = 0;   // of _paceCount bytes, as measured last
  uint64_t _paceCount = 0;
};

}  // namespace scope
