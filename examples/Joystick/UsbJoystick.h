// A USB joystick on all cores that can make one; on the others its report is printed.
#pragma once

#include <Arduino.h>
#include <elapsedMillis.h>

// 18 bytes: the PC reads them as UsbReport says.
struct JoystickReport {
  int16_t axes[8];   // -1000..1000
  uint16_t buttons;  // a bit each, bit 0: button 1
};

// These cores accept a custom report descriptor.
#if defined(USBCON) && (defined(ARDUINO_ARCH_AVR) || defined(ARDUINO_ARCH_SAMD)) && !defined(USE_TINYUSB)
#define USB_JOYSTICK_ARDUINO
#elif defined(ESP32) && CONFIG_TINYUSB_HID_ENABLED && !ARDUINO_USB_MODE
#define USB_JOYSTICK_ESP32
#endif

#if defined(USB_JOYSTICK_ARDUINO) || defined(USB_JOYSTICK_ESP32)
const uint8_t UsbReportId = 3;  // Arduino's Mouse has 1, its Keyboard 2
const uint8_t UsbReport[] PROGMEM = {
    0x05, 0x01,        // usage page: generic desktop
    0x09, 0x05,        // usage: game pad
    0xA1, 0x01,        // collection: application
    0x85, 3,           //   report ID
    0x16, 0x18, 0xFC,  //   logical minimum: -1000
    0x26, 0xE8, 0x03,  //   logical maximum: 1000
    0x19, 0x30,        //   usages: X, Y, Z, Rx, Ry, Rz, slider,
    0x29, 0x37,        //     dial
    0x75, 16,          //   report size: bits
    0x95, 8,           //   report count
    0x81, 0x02,        //   input: data, variable, absolute
    0x05, 0x09,        //   usage page: buttons
    0x19, 1,           //   usages: 1
    0x29, 16,          //     to 16
    0x15, 0,           //   logical minimum
    0x25, 1,           //   logical maximum
    0x75, 1,           //   report size
    0x95, 16,          //   report count
    0x81, 0x02,        //   input
    0xC0,              // end of the collection
};
#endif

#if defined(USB_JOYSTICK_ARDUINO)
#include <HID.h>

class UsbJoystick {
 public:
  // Runs before setup(): the core describes itself to the PC before it calls setup().
  UsbJoystick() : _part(UsbReport, sizeof UsbReport) { HID().AppendDescriptor(&_part); }
  void begin() {}

  // Waits for the PC, for 250 ms at most.
  void send(const JoystickReport &report) { HID().SendReport(UsbReportId, &report, sizeof report); }

 private:
  HIDSubDescriptor _part;
};

#elif defined(USB_JOYSTICK_ESP32)
#include <USB.h>
#include <USBHID.h>

class UsbJoystick : public USBHIDDevice {
 public:
  UsbJoystick() { _hid.addDevice(this, sizeof UsbReport); }
  void begin() {
    _hid.begin();
    USB.begin();
  }

  // Waits for the PC, for 100 ms at most.
  void send(const JoystickReport &report) { _hid.SendReport(UsbReportId, &report, sizeof report); }

  uint16_t _onGetDescriptor(uint8_t *bytes) override {
    memcpy(bytes, UsbReport, sizeof UsbReport);
    return sizeof UsbReport;
  }

 private:
  USBHID _hid;
};

// These two have a Joystick of six axes and 32 buttons, Teensy's with 0..1023.
#elif (defined(CORE_TEENSY) && defined(JOYSTICK_INTERFACE)) || \
    (defined(ARDUINO_ARCH_RP2040) && !defined(ARDUINO_ARCH_MBED))
#if defined(ARDUINO_ARCH_RP2040)
#include <Joystick.h>
#endif

class UsbJoystick {
 public:
  void begin() {
    Joystick.begin();
    Joystick.useManualSend(true);
#if defined(ARDUINO_ARCH_RP2040)
    Joystick.use16bit();
#endif
  }

  void send(const JoystickReport &report) {
    Joystick.X(scaled(report.axes[0]));
    Joystick.Y(scaled(report.axes[1]));
    Joystick.Z(scaled(report.axes[2]));
    Joystick.sliderLeft(scaled(report.axes[3]));
    Joystick.sliderRight(scaled(report.axes[4]));
    Joystick.Zrotate(scaled(report.axes[5]));
    for (uint8_t i = 0; i < 16; i++) {
      Joystick.button(static_cast<uint8_t>(i + 1), (report.buttons >> i & 1) != 0);
    }
    Joystick.send_now();
  }

 private:
#if defined(ARDUINO_ARCH_RP2040)
  static int scaled(int16_t value) { return value * 32767 / 1000; }
#else
  static unsigned scaled(int16_t value) {
    return value == 1000 ? 1023 : static_cast<unsigned>(512 + value * 512 / 1000);
  }
#endif
};

#else
class UsbJoystick {
 public:
  void begin() {}

  void send(const JoystickReport &report) {
    if (_timer < 200) {
      return;
    }
    _timer = 0;
    for (int i = 0; i < 8; i++) {
      Serial.print(report.axes[i]);
      Serial.print(',');
    }
    Serial.println(report.buttons);
  }

 private:
  elapsedMillis _timer;
};
#endif
