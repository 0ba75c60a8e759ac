// The Joystick of two cores: github.com/PaulStoffregen/cores 7f107ee, teensy4/usb_joystick.h, a part of the core; and
// github.com/earlephilhower/arduino-pico 6.0.0 (387294c), libraries/Joystick, whose axes are HID_Joystick's
// (mapBits()). Without useManualSend() each call sends. A Teensy takes 0..1023, and its unsigned values end there; a
// Pico too, without use16bit().
#pragma once

#include <algorithm>

#include "Sent.h"

class StandInJoystick {
 public:
  void begin() {}
  void useManualSend(bool manual) { _manual = manual; }
  void send_now() {
    std::copy(_axes, _axes + 6, sim::usb.axes);
    sim::usb.buttons = _buttons;
    sim::usb.reports.push_back({});
  }
#if defined(CORE_TEENSY)
  using Value = unsigned;
#else
  using Value = int;
  void use16bit() {
    _has16 = true;
  }
#endif
  void X(Value value) {
    set(0, value);
  }
  void Y(Value value) {
    set(1, value);
  }
  void Z(Value value) {
    set(2, value);
  }
  void sliderLeft(Value value) {
    set(3, value);
  }
  void sliderRight(Value value) {
    set(4, value);
  }
  void Zrotate(Value value) {
    set(5, value);
  }
  void button(uint8_t number, bool on) {
    if (--number < 32) {
      _buttons = on ? _buttons | 1u << number : _buttons & ~(1u << number);
      sendUnlessManual();
    }
  }

 private:
  void set(int axis, Value value) {
#if defined(CORE_TEENSY)
    _axes[axis] = static_cast<int>(std::min(value, 1023u));
#else
    _axes[axis] =
        _has16 ? std::min(std::max(value, -32767), 32767) : std::min(std::max(value, 0), 1023) * 65534 / 1023 - 32767;
#endif
    sendUnlessManual();
  }
  void sendUnlessManual() {
    if (!_manual) {
      send_now();
    }
  }
  bool _manual = false;
#if !defined(CORE_TEENSY)
  bool _has16 = false;
#endif
  int _axes[6] = {};
  uint32_t _buttons = 0;
};
extern StandInJoystick Joystick;
