// The PC at the USB of an ATmega32U4: opens its serial port, and takes what it sends, every millisecond. libsimavr has
// the endpoints, but one bank for each instead of two, and no start of a frame, which is made here. What the board
// receives over USB, and descriptors, are left out.
#pragma once

#include <simavr/avr_usb.h>
#include <simavr/sim_avr.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace avr {

class UsbHost {
 public:
  static constexpr uint8_t SerialIn = 3, ReportIn = 4;  // endpoints: CDC.cpp, and the first of PluggableUSB.cpp
  using Packet = std::function<void(uint8_t endpoint, const std::vector<uint8_t> &bytes)>;
  using Byte = std::function<void(uint8_t byte)>;

  // Does nothing on a chip without USB. Calls `byte` when the sketch writes to the serial port, and `packet` when the
  // PC takes one.
  void connect(avr_t *avr, Byte byte, Packet packet);

 private:
  static void attached(avr_irq_t *irq, uint32_t value, void *host);
  static void written(avr_irq_t *irq, uint32_t value, void *host);
  static avr_cycle_count_t everyMillisecond(avr_t *avr, avr_cycle_count_t when, void *host);
  void setUp(std::vector<uint8_t> request);
  void startOfFrame();
  void take(uint8_t endpoint);

  avr_t *_avr = nullptr;
  avr_usb_t *_usb = nullptr;
  bool _reports = false;       // the sketch sends some: otherwise it has no such endpoint
  unsigned _milliseconds = 0;  // since it was plugged in
  Byte _byte;
  Packet _packet;
};

}  // namespace avr
