// See USBHID.h.
#pragma once

#include "USBHID.h"

struct ESPUSB {
  bool begin() {
    sim::usb.descriptor.resize(USBHID::length);
    sim::usb.isAttached = USBHID::added->_onGetDescriptor(sim::usb.descriptor.data()) == USBHID::length;
    return sim::usb.isAttached;
  }
};
extern ESPUSB USB;
