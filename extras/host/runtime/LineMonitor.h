// What went over the wire, whether the sketch received it or not.
#pragma once

#include "BoardUart.h"
#include "Line.h"
#include "sbus/Receiver.h"

namespace host {

class LineMonitor {
 public:
  // Begins anew on a wire whose characters take so long.
  void reset(uint64_t nowUs, uint32_t characterUs);

  void look(const Character &character);

  // Nothing else has come up to now.
  void settle(uint64_t nowUs);

  unsigned long characters() const { return _characters; }
  unsigned long badCharacters() const { return _badCharacters; }
  const sbus::Counters &counters() const { return _receiver.counters(); }

 private:
  void poll(uint64_t nowUs);

  BoardUart _uart;  // polled at once, whenever it hands over
  sbus::Receiver _receiver;
  uint32_t _characterUs = CharacterUs;
  uint64_t _lastEndUs = 0;
  unsigned long _characters = 0;
  unsigned long _badCharacters = 0;
};

}  // namespace host
