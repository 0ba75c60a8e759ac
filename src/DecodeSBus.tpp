// The methods of DecodeSBusOf, for the files that compile one format each: in one file the compiler would inline less.
#include "DecodeSBus.h"
#include "sbus/Barrier.h"

namespace {

// Returns true if a frame has come within the timeout.
inline bool isYoung(sbus::LinkState state) {
  return state != sbus::LinkState::NeverSeen && state != sbus::LinkState::Stale;
}

}  // namespace

template <typename Format, typename Events>
void DecodeSBusOf<Format, Events>::begin(unsigned long baud, uint32_t config) {
  _port.open(baud, config);
  listen(baud);
}

template <typename Format, typename Events>
void DecodeSBusOf<Format, Events>::listen(unsigned long baud) {
  const unsigned long us = baud > sbus::SlowestBaud ? sbus::BitsPerCharacter * 1000000UL / baud : UINT8_MAX;
  _finder.reset(micros(), static_cast<uint8_t>(us), _port.idleCharacters());
  _link.reset();
  _decoded = 0;
  _staleExtra = 0;
}

template <typename Format, typename Events>
void DecodeSBusOf<Format, Events>::end() {
  _port.close();
}

// Reads only the bytes that wait when it is called: bytes that come meanwhile may stand after a loss. Asked for more,
// the STM32L0's core would write past the end of the buffer.
template <typename Format, typename Events>
void DecodeSBusOf<Format, Events>::parseSBusFrame() {
  const uint32_t now = micros();
  const int found = _port.available();
  if (Events::wantsTimes()) {
    _finder.events().asked(found, micros());
  }
  if (found <= 0) {
    if (const uint8_t *const frame = _finder.idle(now)) {
      _link.frame(Format::flags(frame));
    }
    return;
  }
  if (_port.mayHaveLostOldest(static_cast<unsigned>(found))) {
    _finder.broken();  // the bytes that wait stand after the loss
  }
  _finder.poll(static_cast<unsigned>(found), now);
  for (int waiting = found; waiting > 0;) {
    const int room = _finder.room();
    const int count = _port.read(_finder.space(), static_cast<size_t>(waiting < room ? waiting : room));
    if (count <= 0) {
      return;  // the port fails
    }
    waiting -= count;
    if (const uint8_t *const frame = _finder.received(count, waiting)) {
      _link.frame(Format::flags(frame));
    }
  }
  // With the bytes that have come since, the port's buffer may have been full before it was read. Then bytes were lost,
  // and those that have come may stand before the loss or after it.
  if (_port.losesNewest() && static_cast<unsigned>(found) > _port.half()) {
    int more = _port.available();
    if (static_cast<unsigned>(found + more) > 2 * _port.half()) {
      _finder.broken();
      for (; more > 0; more--) {
        _port.skip();
      }
    }
  }
}

// If a frame comes between the two reads of frameTime(), the state belongs to neither: then both are read again.
template <typename Format, typename Events>
sbus::LinkState DecodeSBusOf<Format, Events>::linkState() {
  for (;;) {
    const uint32_t time = _finder.frameTime();
    sbus::barrier();
    const sbus::LinkState state = _link.state(time, micros());
    sbus::barrier();
    if (time == _finder.frameTime()) {
      return state;
    }
  }
}

template <typename Format, typename Events>
bool DecodeSBusOf<Format, Events>::SBusFrameOk() {
  return isYoung(linkState());
}

template <typename Format, typename Events>
unsigned long DecodeSBusOf<Format, Events>::frameAge() {
  return linkState() == sbus::LinkState::NeverSeen ? ULONG_MAX : _link.age() / 1000;
}

template <typename Format, typename Events>
void DecodeSBusOf<Format, Events>::decodeSBusFrame(uint16_t channels[], bool &failsafe, bool &lostFrame) {
  if (!isYoung(linkState())) {
    failsafe = true;
    lostFrame = true;
    return;
  }
  // If a frame is completed meanwhile, the next one may overwrite the frame that is being read: then read the new one.
  uint32_t number;
  do {
    number = _finder.counters().frames;
    sbus::barrier();
    const uint8_t *const frame = _finder.newest();
    Format::unpack(frame, channels);
    lostFrame = (Format::flags(frame) & sbus::FlagLostFrame) != 0;
    failsafe = _link.isLost();
    sbus::barrier();
  } while (number != _finder.counters().frames);
  _decoded = number;
}

// Member by member: if the whole class were instantiated, nothing would be inlined.
#define SBUS_COMPILE_DECODER(...)                                                       \
  template void DecodeSBusOf<__VA_ARGS__>::begin(unsigned long, uint32_t);              \
  template void DecodeSBusOf<__VA_ARGS__>::listen(unsigned long);                       \
  template void DecodeSBusOf<__VA_ARGS__>::end();                                       \
  template void DecodeSBusOf<__VA_ARGS__>::parseSBusFrame();                            \
  template bool DecodeSBusOf<__VA_ARGS__>::SBusFrameOk();                               \
  template void DecodeSBusOf<__VA_ARGS__>::decodeSBusFrame(uint16_t[], bool &, bool &); \
  template sbus::LinkState DecodeSBusOf<__VA_ARGS__>::linkState();                      \
  template unsigned long DecodeSBusOf<__VA_ARGS__>::frameAge();
