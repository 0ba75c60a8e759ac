// Measures the time from reading a frame's last character to its effect, for `joystick` and `bridge`. Until the decoder
// is in sync, a frame waits for later characters.
#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <string>
#include <vector>

namespace tool {

class Latency {
 public:
  void tick() { _loop++; }
  void read() { _reads.push_back({Clock::now(), _loop}); }

  // Takes the number of the oldest characters that are now decoded; `written`: they were a frame and had an effect.
  void passed(size_t characters, bool written);

  // Returns "last byte read to event written: median 60 us, ..." for `what` "event".
  std::string text(const char *what);

 private:
  using Clock = std::chrono::steady_clock;
  struct Read {
    Clock::time_point time;
    unsigned long loop;
  };
  std::deque<Read> _reads;  // of the characters that are not in a stretch yet
  std::vector<unsigned> _us;
  std::vector<unsigned> _lateUs;
  unsigned long _loop = 0;
};

}  // namespace tool
