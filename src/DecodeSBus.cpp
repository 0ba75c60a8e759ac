#include "DecodeSBus.h"

#include <stddef.h>

namespace {

// The core's buffer. A look that finds this many bytes, or one less, may have found it full, and then the core has
// dropped the newest bytes: the break lies behind the last one. One less, because a core may keep a place free (AVR).
constexpr int BufferSize = 64;
constexpr int BufferFull = BufferSize - 1;

// Here a character lasts 255 us. A slower port, or one of 0 baud, is opened as told, but hears no S.Bus.
constexpr unsigned long SlowestBaud = 47059;

// Reads what waits, up to `size` bytes: in one call where the core has read(buffer, size), else byte by byte.
template <typename Port>
auto readWaiting(Port &port, uint8_t *buffer, size_t size, int) -> decltype(port.read(buffer, size)) {
  return port.read(buffer, size);
}

template <typename Port>
int readWaiting(Port &port, uint8_t *buffer, size_t size, long) {
  int count = 0;
  while (count < static_cast<int>(size) && port.available() > 0) {
    buffer[count++] = static_cast<uint8_t>(port.read());
  }
  return count;
}

// A frame has come, and within the timeout.
inline bool isYoung(sbus::LinkState state) {
  return state != sbus::LinkState::NeverSeen && state != sbus::LinkState::Stale;
}

// Between two of these the compiler keeps its reads: what parseSBusFrame() writes may change at any instruction. (A
// macro, because -Os makes a call of an inline function.)
#define READ_ANEW() __atomic_signal_fence(__ATOMIC_SEQ_CST)

}  // namespace

void DecodeSBus::begin(unsigned long baud) {
  begin(baud, sbus::PortConfig);
}

void DecodeSBus::begin(unsigned long baud, uint32_t config) {
  const unsigned long us = baud > SlowestBaud ? sbus::BitsPerCharacter * 1000000UL / baud : UINT8_MAX;
  _receiver.reset(micros(), static_cast<uint8_t>(us));
  _link.reset();
  _decoded = 0;
  sbus::open(_serial, &HardwareSerial::begin, baud, config);
}

void DecodeSBus::end() {
  _serial.end();
}

// Takes in what waits now and no more: what comes meanwhile may stand behind a break, and is there at the next call.
void DecodeSBus::parseSBusFrame() {
  const uint32_t now = micros();
  int room = _receiver.room();
  int count = readWaiting(_serial, _receiver.space(), static_cast<size_t>(room), 0);
  int waiting = count == room ? _serial.available() : 0;
  const bool full = count + waiting >= BufferFull;
  if (full && waiting > BufferSize - count) {
    waiting = BufferSize - count;  // the others came in behind read()
  }
  for (;;) {
    if (const uint8_t *const frame = _receiver.received(count, waiting, now)) {
      _link.frame(frame[sbus::FlagsIndex]);
    }
    if (waiting <= 0 || count <= 0) {
      break;
    }
    room = _receiver.room();
    count = readWaiting(_serial, _receiver.space(), static_cast<size_t>(waiting < room ? waiting : room), 0);
    waiting -= count;
  }
  if (full) {
    _receiver.broken();
  }
}

// A frame that comes in between is younger than the clock that was read: then everything is read again.
sbus::LinkState DecodeSBus::linkState() {
  for (;;) {
    const uint32_t time = _receiver.frameTime();
    READ_ANEW();
    const sbus::LinkState state = _link.state(time, micros());
    READ_ANEW();
    if (time == _receiver.frameTime()) {
      return state;
    }
  }
}

bool DecodeSBus::SBusFrameOk() {
  return isYoung(linkState());
}

unsigned long DecodeSBus::frameAge() const {
  if (!_link.seen()) {
    return ULONG_MAX;
  }
  for (;;) {
    READ_ANEW();
    const uint32_t time = _receiver.frameTime();
    const uint32_t age = micros() - time;
    READ_ANEW();
    if (time == _receiver.frameTime()) {
      return age / 1000;
    }
  }
}

void DecodeSBus::decodeSBusFrame(uint16_t channels[], bool &failsafe, bool &lostFrame) {
  if (!isYoung(linkState())) {
    failsafe = true;
    lostFrame = true;
    return;
  }
  // A frame that completes meanwhile moves the one being read to where the next comes in: then read the newer one.
  uint32_t number;
  do {
    number = _receiver.counters().frames;
    READ_ANEW();
    const uint8_t *const frame = _receiver.newest();
    sbus::unpackAligned(frame, channels);
    lostFrame = sbus::lostFrame(frame);
    failsafe = _link.givenUp();
    READ_ANEW();
  } while (number != _receiver.counters().frames);
  _decoded = number;
}
