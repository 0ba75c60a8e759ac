#include "BoardTransmitter.h"

#include <algorithm>

namespace host {

namespace {

constexpr uint64_t NsPerUs = 1000;

}  // namespace

void BoardTransmitter::open(uint64_t characterNs) {
  close();
  _open = true;
  _characterNs = characterNs;
}

void BoardTransmitter::close() {
  _open = false;
  _first = 0;
  _count = 0;
  _packet = 0;
  _sent = 0;
  _begun = 0;
}

size_t BoardTransmitter::write(uint64_t nowUs, const uint8_t *bytes, size_t size) {
  if (!_open) {
    return 0;
  }
  const size_t taken = std::min(size, RingSize - _count);
  for (size_t i = 0; i < taken; i++) {
    _ring[(_first + _count) % RingSize] = bytes[i];
    _count++;
  }
  if (_packet == 0) {
    beginPacket(std::max(nowUs * NsPerUs, _freeNs));
  }
  return taken;
}

bool BoardTransmitter::next(uint64_t nowUs, line::Character &character) {
  if (_packet == 0 || endUs(_sent + 1) > nowUs) {
    return false;
  }
  character.endUs = endUs(_sent + 1);
  character.value = _ring[(_first + _sent) % RingSize];
  character.bad = false;
  _sent++;
  if (_sent == _packet) {
    _first = (_first + _packet) % RingSize;
    _count -= _packet;
    _freeNs = _packetNs + _packet * _characterNs;
    beginPacket(_freeNs);
  }
  return true;
}

bool BoardTransmitter::begun(uint64_t nowUs, line::Character &character) {
  if (_begun >= _packet || _packetNs + _begun * _characterNs > nowUs * NsPerUs) {
    return false;
  }
  character = line::Character();
  character.endUs = endUs(_begun + 1);
  character.value = _ring[(_first + _begun) % RingSize];
  _begun++;
  return true;
}

void BoardTransmitter::beginPacket(uint64_t fromNs) {
  _packet = std::min({_count, size_t{PacketSize}, RingSize - _first});
  _sent = 0;
  _begun = 0;
  _packetNs = fromNs;
}

// Returns when this many of the packet's characters have been sent, rounded up.
uint64_t BoardTransmitter::endUs(size_t characters) const {
  return (_packetNs + characters * _characterNs + NsPerUs - 1) / NsPerUs;
}

}  // namespace host
