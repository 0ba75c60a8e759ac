/// @file
/// Derives when a frame ended from the fill level of a UART's receive FIFO, for a driver that hands characters over at
/// unknown times.
#pragma once

#include <stdint.h>

#include "FrameEnd.h"

namespace sbus {

/// The FIFO counts each character at once, even if the driver's interrupt and the sketch's tasks are delayed: if it
/// holds one more than at the previous look, a character came between the two looks. A late look makes the bounds wide,
/// never wrong.
///
/// That character is the last one handed over if the driver then hands over as many as the FIFO held: no other
/// characters waited before these, neither where the sketch reads nor on their way there, since the driver had taken
/// none for longer than its interrupt lasts.
class FifoWatch {
 public:
  /// Takes a poll: by the time `by` the driver had handed over `found` characters, which were read. Later, at a time
  /// between `from` and `to`, the FIFO held `fill`.
  void poll(unsigned found, uint32_t by, uint32_t from, unsigned fill, uint32_t to) {
    if (found != 0) {
      _end = found == _count && by - _by <= WaitMax ? frameEndOf(ReceiveNotice::EachCharacter, 1, _before, _by)
                                                    : unknown(by);
      _count = 0;
    }
    if (fill < _fill || to - _from > Close) {
      _since = to;
    } else if (fill == _fill + 1 && static_cast<int32_t>(_from - _since) >= Interrupt) {
      _before = _from;
      _by = to;
      _count = fill;
    }
    _from = from;
    _fill = fill;
  }

  /// Returns when the last of the characters came that the newest poll has found, if it has found any.
  FrameEnd end() const { return _end; }

  /// Returns bounds that are good enough to look for the next frame, but too wide to answer this one: a port waits for
  /// two more characters, its driver's interrupt is late, and so is the poll.
  static FrameEnd unknown(uint32_t by) { return {by - 1000, by}; }

 private:
  static constexpr uint32_t Close = 100;     // us between looks: at most one character, and one burst, came
  static constexpr int32_t Interrupt = 100;  // us: the longest that a driver's interrupt takes once it has begun
  static constexpr uint32_t WaitMax = 1900;  // us: 16 characters, and a FIFO that loses some has had 128

  uint32_t _from = 0;  // the newest look, and what it saw
  unsigned _fill = 0;
  uint32_t _since = 0;  // the looks since then have missed nothing
  unsigned _count = 0;  // of the FIFO when its last character came between _before and _by; 0: not known
  uint32_t _before = 0, _by = 0;
  FrameEnd _end = {0, 0};
};

}  // namespace sbus
