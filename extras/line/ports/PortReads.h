// Turns the reads of a port into characters with times. A port delivers bytes late and in bursts: an FTDI adapter every
// 16 ms, in packets of 62. Within a read there may be any gaps between bytes. Between two reads the line was certainly
// silent only while the port was empty, less the port's latency.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "line/Line.h"

namespace line {

class PortReads {
 public:
  // Linux's default for FTDI's latency timer; other adapters wait less.
  static constexpr uint32_t UsualLatencyUs = 16000;

  explicit PortReads(uint32_t characterUs = CharacterUs, uint32_t latencyUs = UsualLatencyUs)
      : _characterUs(characterUs), _lateUs(latencyUs + SystemUs) {}

  // Takes an empty read at `nowUs`.
  void empty(uint64_t nowUs) { _emptyUs = nowUs; }

  // Takes a read of `count` characters at `nowUs`; get each with next(). After the PC stalls, a read returns the bytes
  // of seconds at once: those that would end more than `aheadUs` after the read follow each other after 1 us.
  void begin(size_t count, uint64_t nowUs, uint64_t aheadUs = UINT64_MAX) {
    _latestUs = aheadUs < UINT64_MAX ? nowUs + aheadUs : UINT64_MAX;
    const uint64_t earliestUs = nowUs - std::min(nowUs, uint64_t{count - 1} * _characterUs);
    _nextUs = std::max(_nextUs, earliestUs);
    _stepUs = _characterUs;
    _readLateUs = static_cast<uint32_t>(std::min<uint64_t>(_lateUs + nowUs - _emptyUs, UINT32_MAX));
  }

  // Takes a read of `count` characters that a stalled port has held back since `fromUs`, though it said that it was
  // empty. They were sent every `stepUs` on average.
  void beginHeld(size_t count, uint64_t fromUs, uint64_t stepUs, uint64_t nowUs) {
    const uint64_t nextUs = std::max(_nextUs, fromUs + stepUs);
    _emptyUs = fromUs;
    begin(count, nowUs, 0);
    _nextUs = nextUs;
    _stepUs = std::min(stepUs, (nowUs - fromUs) / count);
  }

  Character next(uint8_t value, bool bad = false) {
    Character character;
    character.endUs = _nextUs;
    character.value = value;
    character.bad = bad;
    character.lateUs = _readLateUs;
    _nextUs = std::min(_nextUs + _stepUs, std::max(_nextUs + 1, _latestUs));
    return character;
  }

  // Returns how long after the last bytes an empty read proves a gap.
  int knownAfterMs() const { return static_cast<int>(_lateUs / 1000) + 1; }

  // Returns the time of the last empty read.
  uint64_t emptyUs() const { return _emptyUs; }

  // Returns the time up to which all characters are known.
  uint64_t knownUs() const { return _emptyUs - std::min<uint64_t>(_emptyUs, _lateUs); }

 private:
  static constexpr uint32_t SystemUs = 2000;  // delay by USB and the system, on a busy PC

  uint32_t _characterUs;
  uint32_t _lateUs;
  uint32_t _readLateUs = 0;
  uint64_t _emptyUs = 0;
  uint64_t _nextUs = 0;  // the earliest end of the next character
  uint64_t _latestUs = 0;
  uint64_t _stepUs = 0;  // from one to the next
};

}  // namespace line
