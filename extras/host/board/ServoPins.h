// The pins at which the sketch has attached servos, and the pulses that it has set.
#pragma once

#include <map>

namespace host {

class ServoPins {
 public:
  struct Use {
    unsigned long times = 0;  // how often it was set,
    int low = 0;              // and its range, in us
    int high = 0;
  };

  void attached(int pin) { _uses[pin]; }

  void set(int pin, int us) {
    Use &use = _uses[pin];
    use.low = use.times == 0 || us < use.low ? us : use.low;
    use.high = use.times == 0 || us > use.high ? us : use.high;
    use.times++;
  }

  const std::map<int, Use> &uses() const { return _uses; }  // by the number of the pin

 private:
  std::map<int, Use> _uses;
};

}  // namespace host
