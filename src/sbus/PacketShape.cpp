#include "PacketShape.h"

#include "Frame.h"

namespace sbus {

namespace {

constexpr uint8_t SizeMin = 5;  // bytes; telemetry slots have three
constexpr uint8_t SizeMax = 64;

}  // namespace

void PacketShape::put(uint8_t byte) {
  const uint8_t at = _packet.size;
  if (at == 0) {
    _packet.first = byte;
  } else if (at == FlagsIndex) {
    _packet.flags = byte;
  } else if (at == EndIndex) {
    _end = byte;
  } else if (at == FrameSize24 - 1) {
    _endsAs24 = isFlagsByte(_packet.last) && isEndByte(byte);
  }
  _packet.last = byte;
  _packet.size = static_cast<uint8_t>(at < UINT8_MAX ? at + 1 : at);
}

void PacketShape::spoil() { _isSpoilt = true; }

// Returns what the packet has that a frame, perhaps with a tail, does not have; NoSignal if it is one.
Finding PacketShape::fault() const {
  const bool hasHeader = (_packet.first & HeaderMask) == HeaderByte;
  if (hasHeader && _packet.size >= FrameSize24 && _endsAs24) {
    return Finding::NoSignal;
  }
  if (!hasHeader || _packet.size < FrameSize || !isEndByte(_end)) {
    return Finding::WrongPackets;
  }
  return isFlagsByte(_packet.flags) ? Finding::NoSignal : Finding::UnusedFlags;
}

void PacketShape::gap() {
  const bool isSame = _packet.size == _usual.size && _packet.first == _usual.first;
  if (_packet.size == 0) {
    return;
  }
  if (_isSpoilt || _packet.size > SizeMax) {
    _run = 0;
  } else if (fault() == Finding::NoSignal) {
    // Noise takes a byte from some frames, and leaves others whole. A wrong flag comes and goes.
    _run = _usual.size == FrameSize && _usual.first == HeaderByte ? _run : 0;
  } else if (_packet.size >= SizeMin) {
    _run = isSame ? static_cast<uint8_t>(_run < PacketsMin ? _run + 1 : _run) : 1;
    _usual = _packet;
    _found = _run == PacketsMin ? fault() : _found;
  }
  _packet.size = 0;
  _isSpoilt = false;
}

}  // namespace sbus
