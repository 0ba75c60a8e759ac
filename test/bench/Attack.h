// Calls of parseSBusFrame(), of which the last is measured: the calls before it bring the receiver into its state.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "line/Line.h"
#include "support/Bytes.h"
#include "support/FakeClock.h"

#include "Cost.h"  // last: Arduino.h has a type named byte

struct Attack {
  struct Call {
    size_t size;       // bytes that wait; 0: none do
    uint32_t quietUs;  // since the call before, plus the time that the bytes take: no line is faster

    uint32_t gapUs() const { return static_cast<uint32_t>(size) * line::CharacterUs + quietUs; }
  };
  std::vector<Call> calls;
  Bytes bytes;  // of all calls

  // Adds the last call.
  void add(const Bytes &more, uint32_t quietUs) {
    calls.push_back({more.size(), quietUs});
    bytes.insert(bytes.end(), more.begin(), more.end());
  }
};

// Returns an attack as a text: a call a line, "+US HEX HEX ...", the time since the call before, or begin().
std::string textOf(const Attack &attack);

// Three times this frame, every 9 ms: the receiver is in sync.
inline Attack inSync(const Frame &frame) {
  Attack attack;
  for (int i = 0; i < 3; i++) {
    const Bytes bytes = bytesOf(frame) + tailOf(frame[24]);
    attack.add(bytes, 9000 - static_cast<uint32_t>(bytes.size()) * line::CharacterUs);
  }
  return attack;
}

// Returns the cost of the last call. If it finds a full buffer, the driver hands over a burst more meanwhile.
template <typename Receiver>
Cost costOf(const Attack &attack) {
  fakeMicros = 0;
  Receiver both;
  both.receiver.begin();
  Cost cost;
  const uint8_t *next = attack.bytes.data();
  constexpr size_t Full = 64, Burst = 16;
  for (const Attack::Call &call : attack.calls) {
    fakeMicros += call.gapUs();
    cost = take(both, next, call.size, call.size == Full ? Burst : 0);
    next += call.size;
  }
  return cost;
}
