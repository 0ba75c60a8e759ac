// Finds the frames in a stream of bytes. It neither decodes them (Frame.h) nor knows where the bytes come from.
#pragma once

#include <stdint.h>

#include "Frame.h"

namespace sbus {

// Two buffers of 25 bytes: one holds the last complete frame, the other the frame that is coming in. Their roles are
// swapped when a frame is complete; no frame is ever copied. Bytes are read straight into the incoming frame:
//
//   while (uint8_t count = read(receiver.space(), receiver.room())) receiver.received(count);
//
// Call it as often as bytes come; one call costs time in proportion to `count`. Not reentrant: received() and frame()
// belong in the same context.
class Receiver {
 public:
  // Forgets everything, as a new object does.
  void reset();

  // Where the next bytes go, and how many fit there: 1..25.
  uint8_t *space() { return _incoming + _filled; }
  uint8_t room() const { return static_cast<uint8_t>(FrameSize - _filled); }

  // `count` bytes, at most room(), were written to space(). True if they completed a frame.
  bool received(uint8_t count);

  // The line lost bytes behind the last one received: what has come of the incoming frame will never be completed.
  void broken() { _filled = 0; }

  // The last complete frame, 25 bytes; nullptr before the first. Valid until received() has returned true again.
  const uint8_t *frame() const { return _hasFrame ? _complete : nullptr; }

 private:
  void discardToHeader(uint8_t from);

  uint8_t _frames[2][FrameSize];
  uint8_t *_complete = _frames[0];
  uint8_t *_incoming = _frames[1];
  uint8_t _filled = 0;
  bool _hasFrame = false;

 public:
  Receiver() = default;
  Receiver(const Receiver &) = delete;  // its pointers lead into itself
  Receiver &operator=(const Receiver &) = delete;
};

}  // namespace sbus
