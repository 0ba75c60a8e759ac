#include "Arduino.h"

size_t Stream::readBytes(uint8_t *buffer, size_t size) {
  size_t count = 0;
  uint32_t lastMs = millis();
  while (count < size) {
    const int next = read();
    const uint32_t nowMs = millis();
    if (next >= 0) {
      buffer[count++] = static_cast<uint8_t>(next);
      lastMs = nowMs;
    } else if (nowMs - lastMs >= _timeout) {
      break;
    }
  }
  return count;
}
