// The alarms of the pico-sdk's microsecond timer, and the core that runs.
#pragma once

namespace sim {

struct Alarms {
  static constexpr unsigned Count = 4;
  unsigned claimed = 8;                                 // bits; 3 is the default pool's (pico_time/time.c:84)
  unsigned priority[Count] = {0x80, 0x80, 0x80, 0x80};  // of their interrupts
  void (*callback[Count])(unsigned) = {};
  unsigned core = 0;
};
extern Alarms alarms;

}  // namespace sim
