/// @file
/// Reads a port into a FrameFinder, and tells the link of each frame.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "../sbus/FrameFinder.h"

namespace sbus {

// Brings a port's bytes to a FrameFinder, and what it finds to a Link. `Port` is a CallbackPort, and `Link` a
// ClockedLink: no core is known here.
//
// Other contexts must not poll meanwhile: see DecodeSBusOf::Lock.
template <typename Format, typename Events, typename Port, typename Link>
class PortReader {
 public:
  // Remembers `port`.
  template <typename Class>
  explicit PortReader(Class &port) : _port(port) {}
  // Remembers `port` and its pins.
  template <typename Class>
  PortReader(Class &port, int8_t rx, int8_t tx) : _port(port, rx, tx) {}

  // Forgets all frames and counters, and starts at `baud`.
  void reset(unsigned long baud) {
    const unsigned long us = baud > SlowestBaud ? BitsPerCharacter * 1000000UL / baud : UINT8_MAX;
    _finder.reset(Port::now(), static_cast<uint8_t>(us), _port.idleCharacters(baud));
    if (Port::TellsLoss && _port.tellsLoss()) {
      _finder.trustPort();
    }
    _link.reset();
    _link.start();
  }

  // The port calls this when bytes have come.
  void onReceive() {
    if (!Events::wantsTimes() && _port.isAtHalf()) {
      _port.rearm();  // before the bytes are counted: those that come meanwhile must call, too
      if (_finder.mayWait(_port.waiting(), Port::now())) {  // one read for a frame costs less than two
        return;
      }
    }
    pollAll(true);
  }

  // Polls, and once more if the port has called back meanwhile.
  void pollAll(bool fromCallback) {
    while (_port.tryLock()) {
      poll(fromCallback);
      if (!_port.unlock()) {
        return;
      }
    }
  }

  // Reads what is pending when it is called: later bytes may follow a loss.
  void poll(bool fromCallback) {
    fromCallback = Port::HasCallback && fromCallback;
    const uint32_t asked = Port::now();
    const int found = _port.available();
    uint32_t now = asked;
    if (Events::wantsTimes()) {
      _finder.events().polled(found, Port::now());
    } else if (found > 0 && !fromCallback) {
      now = Port::now();  // an interrupt may have come before available() or after it
    }
    if (found <= 0) {
      noteFrame(_finder.idle(now));
      return;
    }
    expect(static_cast<unsigned>(found), asked, now, fromCallback);
    if (readAll(found) && _port.isIdle()) {
      noteFrame(_finder.ended());
    }
  }

 protected:
  // First: the short offsets of Thumb instructions then reach its small members, 18 cycles a frame less.
  FrameFinderOf<Format, Events> _finder;
  Port _port;
  Link _link;

 private:
  // Tells the finder of the bytes that it will get, and of what the port has lost before them.
  SBUS_IN_LINE void expect(unsigned found, uint32_t asked, uint32_t now, bool fromCallback) {
    if (_port.mayHaveLostOldest(found)) {
      _finder.bytesLost();
    }
    if (_port.tellsIdle()) {
      _finder.pollIdling(found, now, fromCallback, _port.wasIdle());
    } else {
      // On an AVR only interrupts can stop loop(), and not for long: spare it 60 bytes, and polls that take longer.
      _finder.poll(found, LineTiming::ClockRuns ? asked : now, now);
    }
  }

  // Reads the bytes that a poll has found. Returns false if the port fails, or has lost bytes after them.
  SBUS_IN_LINE bool readAll(int found) {
    for (int waiting = found; waiting > 0;) {
      const int count = readBytes(waiting);
      if (count <= 0) {
        if (Port::TellsLoss && !Events::wantsTimes()) {
          _finder.bytesLost();
        }
        return false;
      }
      waiting -= count;
      noteFrame(_finder.received(count, waiting));
    }
    if (static_cast<unsigned>(found) > _port.halfCapacity() && _port.losesNewest()) {
      return !drop(static_cast<unsigned>(found));
    }
    return true;
  }

  SBUS_IN_LINE void noteFrame(const uint8_t *frame) {
    if (frame != nullptr) {
      updateLink(frame);
    }
  }

  // Updates the link by a frame that has come. Until a sketch has channels, a frame that withholds them is failsafe.
  //
  // If the board has slept since the frame before, what came before the sleep counts as old, and so does this frame:
  // parts of two may have been joined, since the silence between them seemed short.
  //
  // Not inlined: 46 bytes less on an AVR.
  __attribute__((noinline)) void updateLink(const uint8_t *frame) {
    const Counters &counters = _finder.counters();
    const bool hasNone = Format::ZeroMeansLost && counters.lostFrames == counters.frames;
    _link.frame(static_cast<uint8_t>(Format::flags(frame) | (hasNone ? FlagFailsafe : 0)));
    if (_link.noteFrame(_finder.frameTime())) {
      _link.makeOld();
      _finder.events().forgetAll();
    }
  }

  // Counting the bytes that have arrived since a poll found so many, the port's buffer may have overflowed before it
  // was read: then those bytes may stand before the loss or after it. Returns true if it has, and drops them.
  SBUS_IN_LINE bool drop(unsigned found) {
    int more = _port.available();
    if (found + static_cast<unsigned>(more) <= 2 * _port.halfCapacity()) {
      return false;
    }
    _finder.bytesLost();
    while (more > 0) {
      const int count = readBytes(more);
      if (count <= 0) {
        break;
      }
      more -= count;
    }
    return true;
  }

  // Reads the next of the `waiting` bytes: asked for more, the STM32L0's core would write past the end of the buffer.
  // Returns how many, or 0 or less if the port fails.
  __attribute__((always_inline)) int readBytes(int waiting) {
    const int room = _finder.room();
    return _port.read(_finder.space(), static_cast<size_t>(waiting < room ? waiting : room));
  }
};

}  // namespace sbus
