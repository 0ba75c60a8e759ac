#include "UsbHost.h"

#include <simavr/sim_interrupts.h>
#include <simavr/sim_io.h>

#include <cstring>
#include <utility>

namespace avr {

namespace {

// From USBCON on.
constexpr avr_io_addr_t UDINT = 9, UDIEN = 10, UENUM = 17, UEDATX = 25;
constexpr uint8_t StartOfFrame = 0x04;  // SOFI, SOFE
constexpr avr_cycle_count_t CyclesPerMillisecond = 16000;

}  // namespace

void UsbHost::connect(avr_t *avr, Byte byte, Packet packet) {
  _avr = avr;
  _byte = std::move(byte);
  _packet = std::move(packet);
  for (avr_io_t *io = avr->io_port; io != nullptr; io = io->next) {
    if (std::strcmp(io->kind, "usb") == 0) {
      _usb = reinterpret_cast<avr_usb_t *>(io);  // its first member
      avr_irq_register_notify(avr_io_getirq(avr, AVR_IOCTL_USB_GETIRQ(), USB_IRQ_ATTACH), attached, this);
      avr_irq_register_notify(
          avr_iomem_getirq(avr, static_cast<avr_io_addr_t>(_usb->r_usbcon + UEDATX), nullptr, AVR_IOMEM_IRQ_ALL),
          written, this);
    }
  }
}

void UsbHost::attached(avr_irq_t *, uint32_t, void *host) {
  UsbHost &self = *static_cast<UsbHost *>(host);
  avr_cycle_timer_register(self._avr, CyclesPerMillisecond, everyMillisecond, host);
}

void UsbHost::written(avr_irq_t *, uint32_t value, void *host) {
  UsbHost &self = *static_cast<UsbHost *>(host);
  const uint8_t endpoint = self._avr->data[self._usb->r_usbcon + UENUM];
  if (endpoint == SerialIn) {
    self._byte(static_cast<uint8_t>(value));
  }
  self._reports = self._reports || endpoint == ReportIn;
}

avr_cycle_count_t UsbHost::everyMillisecond(avr_t *avr, avr_cycle_count_t when, void *host) {
  UsbHost &self = *static_cast<UsbHost *>(host);
  switch (self._milliseconds++) {
    case 1:
      avr_ioctl(avr, AVR_IOCTL_USB_RESET, nullptr);
      break;
    case 2:
      self.setUp({0x00, 9, 1, 0, 0, 0, 0, 0});
      break;  // SET_CONFIGURATION 1
    case 3:
      self.setUp({0x21, 0x22, 3, 0, 0, 0, 0, 0});
      break;  // CDC_SET_CONTROL_LINE_STATE: a program has opened it
    default:
      if (self._milliseconds > 4) {
        self.take(SerialIn);
        if (self._reports) {
          self.take(ReportIn);
        }
      }
      self.startOfFrame();
  }
  return when + CyclesPerMillisecond;
}

void UsbHost::setUp(std::vector<uint8_t> request) {
  avr_io_usb setup = {0, static_cast<uint32_t>(request.size()), request.data()};
  avr_ioctl(_avr, AVR_IOCTL_USB_SETUP, &setup);
}

void UsbHost::startOfFrame() {
  _avr->data[_usb->r_usbcon + UDINT] |= StartOfFrame;
  if ((_avr->data[_usb->r_usbcon + UDIEN] & StartOfFrame) != 0) {
    for (unsigned i = 0; i < _avr->interrupts.vector_count; i++) {
      if (_avr->interrupts.vector[i]->vector == _usb->usb_gen_vect) {
        avr_raise_interrupt(_avr, _avr->interrupts.vector[i]);
      }
    }
  }
}

void UsbHost::take(uint8_t endpoint) {
  uint8_t bytes[64];
  avr_io_usb read = {endpoint, sizeof bytes, bytes};
  if (avr_ioctl(_avr, AVR_IOCTL_USB_READ, &read) == AVR_IOCTL_USB_OK && read.sz > 0) {
    _packet(endpoint, std::vector<uint8_t>(bytes, bytes + read.sz));
  }
}

}  // namespace avr
