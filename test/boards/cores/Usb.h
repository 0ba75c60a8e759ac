// What a board has told the PC over USB, and the classes of the cores that tell it. build.mk gives it the names of all
// their headers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sim {

using Bytes = std::vector<uint8_t>;

struct Usb {
  Bytes descriptor;            // of reports; empty: the core has one of its own
  std::vector<Bytes> reports;  // with their ID first
  int axes[6];                 // X, Y, Z, RX, RY, RZ of a core's own Joystick ...
  uint32_t buttons;            // ... and its buttons, as sent
  bool isAttached;             // the PC does not see later additions to the descriptor
};
extern Usb usb;

}  // namespace sim

#if defined(CORE_TEENSY) || defined(ARDUINO_ARCH_RP2040)

// The Joystick of two cores: github.com/PaulStoffregen/cores 7f107ee, teensy4/usb_joystick.h, a part of the core; and
// github.com/earlephilhower/arduino-pico 6.0.0 (387294c), libraries/Joystick, whose axes are HID_Joystick's
// (mapBits()). Without useManualSend() each call sends. A Teensy takes 0..1023, and its unsigned values end there; a
// Pico too, without use16bit().
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
  void use16bit() { _has16 = true; }
#endif
  void X(Value value) { set(0, value); }
  void Y(Value value) { set(1, value); }
  void Z(Value value) { set(2, value); }
  void sliderLeft(Value value) { set(3, value); }
  void sliderRight(Value value) { set(4, value); }
  void Zrotate(Value value) { set(5, value); }
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

#elif defined(ESP32)

// github.com/espressif/arduino-esp32, libraries/USB/src/USBHID.h and .cpp, by the sketches that use it: a device gives
// its descriptor when USB.begin() asks for it, and has to be added before.
class USBHIDDevice {
 public:
  virtual uint16_t _onGetDescriptor(uint8_t *) { return 0; }
};

class USBHID {
 public:
  bool addDevice(USBHIDDevice *device, uint16_t size) {
    added = device;
    length = size;
    return true;
  }
  void begin() {}
  bool SendReport(uint8_t id, const void *data, size_t size, uint32_t = 100) {
    sim::Bytes report = {id};
    report.insert(report.end(), static_cast<const uint8_t *>(data), static_cast<const uint8_t *>(data) + size);
    sim::usb.reports.push_back(report);
    return sim::usb.isAttached;
  }
  static USBHIDDevice *added;
  static uint16_t length;
};
struct ESPUSB {
  bool begin() {
    sim::usb.descriptor.resize(USBHID::length);
    sim::usb.isAttached = USBHID::added->_onGetDescriptor(sim::usb.descriptor.data()) == USBHID::length;
    return sim::usb.isAttached;
  }
};
extern ESPUSB USB;

#else

// github.com/arduino/ArduinoCore-avr 1.8.8 (11b9130): libraries/HID/src/HID.h and .cpp; the same in
// ArduinoCore-samd 1.8.14 (993398c). The ID goes before the data (.cpp:89). main() attaches before setup():
// cores/arduino/main.cpp:40.
class HIDSubDescriptor {
 public:
  HIDSubDescriptor(const void *bytes, const uint16_t size) : data(bytes), length(size) {}
  HIDSubDescriptor *next = nullptr;
  const void *data;
  const uint16_t length;
};

class HID_ {
 public:
  void AppendDescriptor(HIDSubDescriptor *node) {
    if (!sim::usb.isAttached) {
      const uint8_t *const bytes = static_cast<const uint8_t *>(node->data);
      sim::usb.descriptor.insert(sim::usb.descriptor.end(), bytes, bytes + node->length);
    }
  }
  int SendReport(uint8_t id, const void *data, int size) {
    sim::Bytes report = {id};
    report.insert(report.end(), static_cast<const uint8_t *>(data), static_cast<const uint8_t *>(data) + size);
    sim::usb.reports.push_back(report);
    return size + 1;
  }
};
inline HID_ &HID() {
  static HID_ hid;
  return hid;
}

#endif
