#include "BoardUart.h"

namespace host {

void BoardUart::open(uint64_t nowUs, uint8_t *buffer, size_t size, uint32_t characterUs) {
  _open = buffer != nullptr && size >= BufferMinimum;
  _openedUs = nowUs;
  _lastEndUs = nowUs;
  _characterUs = characterUs;
  _ringWrite = 0;
  _buffer = buffer;
  _size = size;
  _first = 0;
  _state = {};
  _state.rx_event = true;
  _event = false;
  _isDue = false;
}

void BoardUart::receive(const line::Character &character) {
  if (!_open || character.endUs < _openedUs + _characterUs) {
    return;
  }
  advance(character.endUs - _characterUs);
  _lastEndUs = character.endUs;
  if (character.bad) {
    _droppedBad++;
    handOver();
    return;
  }
  _ring[_ringWrite] = character.value;
  _ringWrite = (_ringWrite + 1) % RingSize;
  // The ring's position survives gaps: each frame of 25 characters is cut at other places than the previous one.
  if (_ringWrite % HandOverSize == 0) {
    handOver();
  }
}

void BoardUart::advance(uint64_t nowUs) {
  if (_open && nowUs >= _lastEndUs + _characterUs) {
    handOver();
  }
}

void BoardUart::mask(bool isMasked) {
  _isMasked = isMasked;
  if (!isMasked && _isDue) {
    handOver();
  }
}

void BoardUart::handOver() {
  if (_isMasked) {
    _isDue = _isDue || _state.rx_index != _ringWrite;
    return;
  }
  _isDue = false;
  while (_state.rx_index != _ringWrite) {
    const uint8_t byte = _ring[_state.rx_index];
    _state.rx_index = (_state.rx_index + 1) % RingSize;
    if (_state.rx_count == _size) {
      _droppedFull++;
      continue;
    }
    _buffer[(_first + _state.rx_count) % _size] = byte;
    _state.rx_count = _state.rx_count + 1;
    if (_state.rx_event) {
      _state.rx_event = false;
      _event = true;
    }
  }
}

int BoardUart::peek() {
  _state.rx_event = true;
  return available() > 0 ? _buffer[_first] : -1;
}

int BoardUart::read() {
  uint8_t byte;
  return read(&byte, 1) == 1 ? byte : -1;
}

int BoardUart::read(uint8_t *buffer, size_t size) {
  _state.rx_event = true;
  size_t done = 0;
  while (done < size && available() > 0) {
    buffer[done++] = _buffer[_first];
    _first = (_first + 1) % _size;
    _state.rx_count = _state.rx_count - 1;
  }
  return static_cast<int>(done);
}

bool BoardUart::takeReceiveEvent() {
  const bool event = _event;
  _event = false;
  return event;
}

}  // namespace host
