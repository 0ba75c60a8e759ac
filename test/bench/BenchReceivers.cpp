#include "BenchReceivers.h"

int MemorySerial::available() {
  static const uint8_t zeros[16] = {};
  calls.available++;
  if (_next == _end && _landing != 0) {
    _next = zeros;
    _end = zeros + _landing;
    _landing = 0;
  }
  return static_cast<int>(_end - _next);
}

int MemorySerial::read() {
  calls.singleReads++;
  return _next == _end ? -1 : *_next++;
}

int MemorySerial::read(uint8_t *buffer, size_t size) {
  const size_t waiting = static_cast<size_t>(_end - _next);
  const size_t count = size < waiting ? size : waiting;
  calls.reads++;
  calls.bytes += static_cast<uint32_t>(count);
  for (size_t i = 0; i < count; i++) {
    buffer[i] = *_next++;
  }
  return static_cast<int>(count);
}

void Ours::parse() { receiver.parseSBusFrame(); }

void Papers::parse() { receiver.parseSBusFrame(); }
