// github.com/espressif/arduino-esp32, libraries/USB/src/USBHID.h and .cpp, by the sketches that use it: a device gives
// its descriptor when USB.begin() asks for it, and has to be added before.
#pragma once

#include <stddef.h>

#include "Sent.h"

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
