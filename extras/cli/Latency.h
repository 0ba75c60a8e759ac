// Measures the time from the read of a frame's last character to what it causes: for `joystick` and `bridge`. Before
// the line is known, a frame waits for later characters.
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

  // Takes the end of the oldest characters; `written`: as a frame they have caused something.
  void passed(size_t characters, bool written);

  // Returns "last byte read to event written: median 60 us, ..." where `what` is event.
  std::string text(const char *what);

 private:
  using Clock = std::chrono::steady_clock;
  struct Read {
    Clock::time_point time;
    unsigned long loop;
  };
  std::deque<Read> _reads;  // of the characters that are no part of a stretch yet
  std::vector<unsigned> _us;
  std::vector<unsigned> _lateUs;
  unsigned long _loop = 0;
};

}  // namespace tool
