// A game controller that looks real to programs, made with Linux's uinput and libevdev.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>

struct libevdev_uinput;

namespace tool {

class GameController {
 public:
  static constexpr int AxisEnd = 1000;  // the range of an axis is -AxisEnd to AxisEnd
  static constexpr size_t Axes = 8;
  static constexpr size_t Buttons = 24;

  struct State {
    std::array<int, Axes> axes{};  // X, Y, Z, RX, RY, RZ, throttle, rudder
    std::array<bool, Buttons> buttons{};
  };

  // Creates the controller in this state. Throws std::runtime_error that says what to do.
  explicit GameController(const State &state);

  // Returns the file that programs open, such as /dev/input/event7.
  std::string name() const;

  // Writes the changes as one report. Throws std::runtime_error.
  void write(const State &state);

 private:
  void send(unsigned type, unsigned code, int value);

  struct Destroy {
    void operator()(libevdev_uinput *device) const;
  };

  State _state;
  std::unique_ptr<libevdev_uinput, Destroy> _device;
};

}  // namespace tool
