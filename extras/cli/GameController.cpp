#include "cli/GameController.h"

#include <stdexcept>

#if defined(WITH_LIBEVDEV)
#include <libevdev/libevdev-uinput.h>

#include <cerrno>
#include <cstring>
#endif

namespace tool {

#if defined(WITH_LIBEVDEV)

namespace {

// The kernel maps the axes of an EdgeTX radio's USB joystick (radio/src/usb_joystick.cpp) in this order:
// drivers/hid/hid-input.c 770 to 909.
constexpr unsigned AxisCodes[GameController::Axes] = {ABS_X,  ABS_Y,  ABS_Z,        ABS_RX,
                                                      ABS_RY, ABS_RZ, ABS_THROTTLE, ABS_RUDDER};

constexpr unsigned buttonCode(size_t button) {
  return static_cast<unsigned>(button < 16 ? BTN_GAMEPAD + button : BTN_TRIGGER_HAPPY + button - 16);
}

std::string reason(int error) {
  const std::string text = std::string("/dev/uinput: ") + std::strerror(error);
  return error == EACCES || error == EPERM
             ? text +
                   ". This lets the user who is logged in at the PC use it: echo '" UDEV_RULE
                   "' | sudo tee /etc/udev/rules.d/60-sbus-uinput.rules; sudo udevadm control --reload; sudo udevadm "
                   "trigger --name-match=uinput"
         : error == ENOENT || error == ENODEV ? text + ". Load the kernel's module: sudo modprobe uinput"
                                              : text;
}

}  // namespace

void GameController::Destroy::operator()(libevdev_uinput *device) const {
  libevdev_uinput_destroy(device);
}

GameController::GameController(const State &state) : _state(state) {
  const std::unique_ptr<libevdev, decltype(&libevdev_free)> plan(libevdev_new(), libevdev_free);
  libevdev_set_name(plan.get(), "S.Bus transmitter");
  libevdev_set_id_bustype(plan.get(), BUS_VIRTUAL);
  for (size_t i = 0; i < Axes; i++) {
    input_absinfo axis{};
    axis.value = state.axes[i];
    axis.minimum = -AxisEnd;
    axis.maximum = AxisEnd;
    libevdev_enable_event_code(plan.get(), EV_ABS, AxisCodes[i], &axis);
  }
  for (size_t i = 0; i < Buttons; i++) {
    libevdev_enable_event_code(plan.get(), EV_KEY, buttonCode(i), nullptr);
  }
  libevdev_uinput *device = nullptr;
  const int error = libevdev_uinput_create_from_device(plan.get(), LIBEVDEV_UINPUT_OPEN_MANAGED, &device);
  if (error != 0) {
    throw std::runtime_error(reason(-error));
  }
  _device.reset(device);
}

std::string GameController::name() const {
  const char *const node = libevdev_uinput_get_devnode(_device.get());
  return node != nullptr ? node : libevdev_uinput_get_syspath(_device.get());
}

// The kernel drops reports without a change (drivers/input/input.c, input_event_dispose()).
void GameController::write(const State &state) {
  bool changed = false;
  for (size_t i = 0; i < Axes; i++) {
    if (state.axes[i] != _state.axes[i]) {
      send(EV_ABS, AxisCodes[i], state.axes[i]);
      changed = true;
    }
  }
  for (size_t i = 0; i < Buttons; i++) {
    if (state.buttons[i] != _state.buttons[i]) {
      send(EV_KEY, buttonCode(i), state.buttons[i]);
      changed = true;
    }
  }
  if (changed) {
    send(EV_SYN, SYN_REPORT, 0);
  }
  _state = state;
}

void GameController::send(unsigned type, unsigned code, int value) {
  const int error = libevdev_uinput_write_event(_device.get(), type, code, value);
  if (error != 0) {
    throw std::runtime_error(reason(-error));
  }
}

#else

void GameController::Destroy::operator()(libevdev_uinput *) const {
}

GameController::GameController(const State &) {
  throw std::runtime_error(
      "this sbus was built without libevdev. On Linux install libevdev-dev and pkg-config, and build it again: make "
      "sbus");
}

std::string GameController::name() const {
  return {};
}

void GameController::write(const State &) {
}

void GameController::send(unsigned, unsigned, int) {
}

#endif

}  // namespace tool
