#include "DecodeSBus.h"

#include <stddef.h>

#if defined(SERIAL_SBUS)
#include <stm32l0_uart.h>  // the option bits that SERIAL_SBUS is made of; Arduino.h does not bring them in
#endif

namespace {

#if defined(SERIAL_SBUS)
constexpr auto PortConfig = SERIAL_SBUS;
#else
constexpr auto PortConfig = SERIAL_8E2;
#endif

// A look that finds this many bytes may have found a full buffer, and then the core has dropped the newest bytes: the
// break lies behind the last byte read. 63, because a core may keep one of its 64 places free, as the AVR's does.
constexpr uint8_t BufferFull = 63;

// Reads what waits, up to `size` bytes: in one call where the core has read(buffer, size), else byte by byte.
template <typename Port>
auto readWaiting(Port &port, uint8_t *buffer, uint8_t size, int) -> decltype(port.read(buffer, size_t(size))) {
  return port.read(buffer, size_t(size));
}

template <typename Port>
int readWaiting(Port &port, uint8_t *buffer, uint8_t size, long) {
  int count = 0;
  while (count < size && port.available() > 0) {
    buffer[count++] = static_cast<uint8_t>(port.read());
  }
  return count;
}

}  // namespace

void DecodeSBus::begin() {
  _receiver.reset();
  _serial.begin(sbus::Baud, PortConfig);
}

void DecodeSBus::end() {
  _serial.end();
}

bool DecodeSBus::SBusFrameOk() const {
  return _receiver.frame() != nullptr;
}

void DecodeSBus::parseSBusFrame() {
  unsigned total = 0;
  for (;;) {
    const int count = readWaiting(_serial, _receiver.space(), _receiver.room(), 0);
    if (count <= 0) {
      break;
    }
    total += static_cast<unsigned>(count);
    _receiver.received(static_cast<uint8_t>(count));
  }
  if (total >= BufferFull) {
    _receiver.broken();
  }
}

void DecodeSBus::decodeSBusFrame(uint16_t channels[], bool &failsafe, bool &lostFrame) const {
  const uint8_t *const frame = _receiver.frame();
  if (frame == nullptr) {
    failsafe = true;
    lostFrame = true;
    return;
  }
  sbus::unpack(frame, channels);
  failsafe = sbus::failsafe(frame);
  lostFrame = sbus::lostFrame(frame);
}
