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
  _port.enter();
  _port.open(baud, config);
  start(baud);
}

template <typename Format, typename Events>
void DecodeSBusOf<Format, Events>::listen(unsigned long baud) {
  _port.enter();
  start(baud);
}

template <typename Format, typename Events>
void DecodeSBusOf<Format, Events>::start(unsigned long baud) {
  reset(baud);
  hear(&DecodeSBusOf::arrived, this);
}

template <typename Format, typename Events>
inline void DecodeSBusOf<Format, Events>::reset(unsigned long baud) {
  const unsigned long us = baud > sbus::SlowestBaud ? sbus::BitsPerCharacter * 1000000UL / baud : UINT8_MAX;
  _finder.reset(micros(), static_cast<uint8_t>(us), _port.idleCharacters());
  _link.reset();
  _link.start();
  _decoded = 0;
}

// Lets the port call `method`. The first poll comes at once: a port that has bytes does not call before they are read.
template <typename Format, typename Events>
template <typename Object>
inline void DecodeSBusOf<Format, Events>::hear(void (Object::*method)(), Object *object) {
  const bool callsBack = _port.start(_port.stream(), method, object);
  _port.leave();
  if (callsBack) {
    take(false);
  }
}

template <typename Format, typename Events>
void DecodeSBusOf<Format, Events>::end() {
  _port.enter();
  _port.close();
  _port.stop(_port.stream());
  _port.leave();
}

template <typename Format, typename Events>
void DecodeSBusOf<Format, Events>::parseSBusFrame() {
  take(false);
}

template <typename Format, typename Events>
void DecodeSBusOf<Format, Events>::arrived() {
  if (!Events::wantsTimes() && _port.isAtHalf() && _finder.mayWait(_port.waiting(), micros())) {
    _port.callAgain();  // one read for a frame costs less than two
    return;
  }
  take(true);
}

// Polls, and once more if the port has called back meanwhile.
template <typename Format, typename Events>
void DecodeSBusOf<Format, Events>::take(bool isPrompt) {
  while (_port.enter()) {
    poll(sbus::Listener::Calls && isPrompt);
    if (!_port.leave()) {
      return;
    }
    isPrompt = true;
  }
}

// Reads the next of the bytes that wait. Returns how many, or 0 or less if the port fails.
template <typename Format, typename Events>
__attribute__((always_inline)) inline int DecodeSBusOf<Format, Events>::read(int waiting) {
  const int room = _finder.room();
  return _port.read(_finder.space(), static_cast<size_t>(waiting < room ? waiting : room));
}

// Judges the link by a frame that has come. Until a sketch has channels, a frame that withholds them is failsafe.
//
// If the board has slept since the frame before, what came before the sleep counts as old, and so does this frame:
// parts of two may have been joined, since the silence between them seemed short.
template <typename Format, typename Events>
inline void DecodeSBusOf<Format, Events>::judge(const uint8_t *frame) {
  const sbus::Counters &counters = _finder.counters();
  const bool hasNone = Format::Withholds && counters.lostFrames == counters.frames;
  _link.frame(static_cast<uint8_t>(Format::flags(frame) | (hasNone ? sbus::FlagFailsafe : 0)));
  if (_link.took(_finder.frameTime())) {
    _link.makeOld();
    _finder.events().forgetAll();
  }
}

// Reads only the bytes that wait when it is called: bytes that come meanwhile may stand after a loss. Asked for more,
// the STM32L0's core would write past the end of the buffer.
template <typename Format, typename Events>
void DecodeSBusOf<Format, Events>::poll(bool isPrompt) {
  uint32_t now = micros();
  const int found = _port.available();
  if (Events::wantsTimes()) {
    _finder.events().asked(found, micros());
  } else if (found > 0 && !isPrompt) {
    now = micros();  // by then the bytes had come: an interrupt may have held up the question
  }
  if (found <= 0) {
    if (const uint8_t *const frame = _finder.idle(now)) {
      judge(frame);
    }
    return;
  }
  const unsigned bytes = static_cast<unsigned>(found);
  if (_port.mayHaveLostOldest(bytes)) {
    _finder.broken();  // the bytes that wait stand after the loss
  }
  int split = 0;
  if (_port.tellsIdle()) {
    split = _finder.pollIdling(bytes, now, isPrompt, _port.wasIdle());
  } else {
    _finder.poll(bytes, now);
  }
  for (int waiting = found; waiting > 0;) {
    const int count = read(split != 0 && split < waiting ? split : waiting);
    if (count <= 0) {
      return;  // the port fails
    }
    waiting -= count;
    if (const uint8_t *const frame = _finder.received(count, waiting)) {
      judge(frame);
    }
    if (split != 0) {
      _finder.likelyGap();
      split = 0;
    }
  }
  if (_port.isIdle() && bytes <= _port.half()) {
    if (const uint8_t *const frame = _finder.ended()) {
      judge(frame);
    }
    return;
  }
  // With the bytes that have come since, the port's buffer may have been full before it was read. Then bytes were lost,
  // and those that have come may stand before the loss or after it.
  if (_port.losesNewest() && bytes > _port.half()) {
    int more = _port.available();
    if (static_cast<unsigned>(found + more) > 2 * _port.half()) {
      _finder.broken();
      while (more > 0) {
        const int count = read(more);
        if (count <= 0) {
          return;
        }
        more -= count;
      }
    }
  }
}

// Returns the state of the link, and the age of the newest frame, us. If a frame comes meanwhile, they belong to
// neither: then all is read again.
template <typename Format, typename Events>
sbus::LinkState DecodeSBusOf<Format, Events>::state(uint32_t &age) {
  for (;;) {
    const uint32_t time = _finder.frameTime();
    sbus::barrier();
    age = _link.age(_link.ageOf(time));
    const sbus::LinkState state = _link.state(age);
    sbus::barrier();
    if (time == _finder.frameTime()) {
      constexpr uint32_t Old = 100000;  // us
      if (_port.callsBack() && (state == sbus::LinkState::NeverSeen || age >= Old)) {
        take(false);  // if the port's call was lost, the next one comes only after a poll
      }
      return state;
    }
  }
}

template <typename Format, typename Events>
sbus::LinkState DecodeSBusOf<Format, Events>::linkState() {
  uint32_t age;
  return state(age);
}

template <typename Format, typename Events>
bool DecodeSBusOf<Format, Events>::SBusFrameOk() {
  return isYoung(linkState());
}

template <typename Format, typename Events>
unsigned long DecodeSBusOf<Format, Events>::frameAge() {
  uint32_t age;
  return state(age) == sbus::LinkState::NeverSeen ? ULONG_MAX : age / 1000;
}

template <typename Format, typename Events>
bool DecodeSBusOf<Format, Events>::read(Frame &frame) {
  parseSBusFrame();
  return newest(frame);
}

// The age is asked for first: a frame that comes in between is younger.
template <typename Format, typename Events>
bool DecodeSBusOf<Format, Events>::newest(Frame &frame) {
  const uint32_t before = _decoded;
  uint32_t age;
  const sbus::LinkState now = state(age);
  frame.age = now == sbus::LinkState::NeverSeen ? ULONG_MAX : age / 1000;
  decode(now, frame.channels, frame.failsafe, frame.lostFrame);
  return _decoded != before;
}

template <typename Format, typename Events>
void DecodeSBusOf<Format, Events>::decodeSBusFrame(ChannelArray channels, bool &failsafe, bool &lostFrame) {
  decode(linkState(), channels, failsafe, lostFrame);
}

template <typename Format, typename Events>
void DecodeSBusOf<Format, Events>::decode(sbus::LinkState state, ChannelArray channels, bool &failsafe,
                                          bool &lostFrame) {
  if (!isYoung(state) || channels == nullptr) {
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
#define SBUS_COMPILE_DECODER(...)                                                                                    \
  template void DecodeSBusOf<__VA_ARGS__>::begin(unsigned long, uint32_t);                                           \
  template void DecodeSBusOf<__VA_ARGS__>::listen(unsigned long);                                                    \
  template void DecodeSBusOf<__VA_ARGS__>::end();                                                                    \
  template void DecodeSBusOf<__VA_ARGS__>::start(unsigned long);                                                     \
  template bool DecodeSBusOf<__VA_ARGS__>::read(DecodeSBusOf<__VA_ARGS__>::Frame &);                                 \
  template bool DecodeSBusOf<__VA_ARGS__>::newest(DecodeSBusOf<__VA_ARGS__>::Frame &);                               \
  template void DecodeSBusOf<__VA_ARGS__>::parseSBusFrame();                                                         \
  template void DecodeSBusOf<__VA_ARGS__>::arrived();                                                                \
  template void DecodeSBusOf<__VA_ARGS__>::take(bool);                                                               \
  template bool DecodeSBusOf<__VA_ARGS__>::SBusFrameOk();                                                            \
  template void DecodeSBusOf<__VA_ARGS__>::decodeSBusFrame(DecodeSBusOf<__VA_ARGS__>::ChannelArray, bool &, bool &); \
  template sbus::LinkState DecodeSBusOf<__VA_ARGS__>::linkState();                                                   \
  template sbus::LinkState DecodeSBusOf<__VA_ARGS__>::state(uint32_t &);                                             \
  template unsigned long DecodeSBusOf<__VA_ARGS__>::frameAge();
