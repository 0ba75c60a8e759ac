// Counts what a line carries from a moment on, for sbus::Diagnosis. `sbus doctor` and the page use it, and a sketch's
// decoder counts in the same way, so all three report the same finding for a line.
#pragma once

#include <algorithm>
#include <cstdint>

#include "line/LineSettings.h"
#include "line/Observer.h"
#include "sbus/Diagnosis.h"

namespace line {

class Examination {
 public:
  // Begins at `nowUs`, in the line's time.
  void begin(const Observer &observer, uint64_t nowUs) {
    _before = observer.counters16();
    _pulselessBefore = observer.pulseless();
    _errorsBefore = observer.characterErrors();
    _beganUs = nowUs;
  }

  // Returns what a port with these settings received from begin() to `nowUs`.
  sbus::Trial trial(const Observer &observer, const LineSettings &port, uint64_t nowUs) const {
    const uint64_t ms = (nowUs - std::min(nowUs, _beganUs)) / 1000;
    const sbus::Finding fault = port.format.parity == Parity::None ? sbus::Finding::NoSignal : observer.senderFault();
    const sbus::Finding protocol = observer.otherProtocol();
    sbus::Trial trial = {port.baud,
                         port.polarity != Polarity::Uninverted,
                         static_cast<uint32_t>(std::clamp<uint64_t>(ms, 1, UINT32_MAX)),
                         difference(observer.counters16(), _before),
                         observer.pulseless() - _pulselessBefore,
                         protocol != sbus::Finding::NoSignal ? protocol : fault};
    // Characters with errors never reach a decoder, and impairedFrames() relies on that. A line with only such
    // characters is not silent.
    if (trial.counters.frames == 0 && trial.counters.discardedBytes == 0) {
      trial.counters.discardedBytes = static_cast<uint32_t>(observer.characterErrors() - _errorsBefore);
    }
    return trial;
  }

 private:
  // Returns now - before. Counters lower than before count from 0, since they are the other decoder's.
  static sbus::Counters difference(sbus::Counters now, const sbus::Counters &before) {
    for (const auto count : AllCounts) {
      now.*count -= std::min(now.*count, before.*count);
    }
    return now;
  }

  sbus::Counters _before{};
  uint32_t _pulselessBefore = 0;
  unsigned long _errorsBefore = 0;
  uint64_t _beganUs = 0;
};

// Returns true if the line has no fault and needs no other decoder.
constexpr bool isWell(sbus::Finding finding) {
  return finding == sbus::Finding::AllWell || finding == sbus::Finding::AllWellAndMore;
}

}  // namespace line
