// The unconnected pins: the levels that the sketch reads, and for the report what it did there.
#pragma once

#include <cstdint>
#include <map>
#include <utility>

namespace host {

class Pins {
 public:
  enum Mode : uint32_t { Input, Output, InputPullUp, InputPullDown };  // as in Arduino.h
  enum Way { Digital, Analog, Tone, Servo };                           // how the sketch drives a pin

  struct Use {
    unsigned long times = 0;  // how often it was set
    int low = 0;              // its range: 0..1, the written value, Hz, us
    int high = 0;
  };

  void setMode(uint32_t pin, Mode mode) { _levels[pin].mode = mode; }

  void write(uint32_t pin, bool high) {
    _levels[pin].written = high;
    use(Digital, pin, high ? 1 : 0);
  }

  bool isHigh(uint32_t pin) const {
    const auto found = _levels.find(pin);
    return found != _levels.end() &&
           (found->second.mode == Output ? found->second.written : found->second.mode == InputPullUp);
  }

  void attachServo(uint32_t pin) { _uses[{Servo, pin}]; }

  void use(Way way, uint32_t pin, int value) {
    Use &use = _uses[{way, pin}];
    use.low = use.times == 0 || value < use.low ? value : use.low;
    use.high = use.times == 0 || value > use.high ? value : use.high;
    use.times++;
  }

  const std::map<std::pair<Way, uint32_t>, Use> &uses() const { return _uses; }

 private:
  struct Level {
    Mode mode = Input;
    bool written = false;
  };

  std::map<uint32_t, Level> _levels;
  std::map<std::pair<Way, uint32_t>, Use> _uses;
};

}  // namespace host
