// github.com/arduino/ArduinoCore-avr 1.8.8 (11b9130): libraries/HID/src/HID.h and .cpp; the same in
// ArduinoCore-samd 1.8.14 (993398c). The ID goes before the data (.cpp:89). main() attaches before setup():
// cores/arduino/main.cpp:40.
#pragma once

#include "Sent.h"

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
