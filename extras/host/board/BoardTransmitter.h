// How the board sends: the path of the bytes from the sketch's write() to the wire.
#pragma once

#include <cstddef>
#include <cstdint>

#include "line/Line.h"

namespace host {

// Bytes wait in a ring of 64. The UART gets them in packets: the bytes waiting when the previous packet has been sent,
// up to 32, and not across the ring's end. A packet's places become free all at once, when its last character has been
// sent; on the wire all characters are back to back, even across packets.
//
// Time comes in as an argument and must not go backwards.
class BoardTransmitter {
 public:
  static constexpr size_t RingSize = 64;
  static constexpr size_t PacketSize = 32;

  // Opens with an empty ring, for characters of this length. Like close(), loses bytes still in it.
  void open(uint64_t characterNs);
  void close();
  bool isOpen() const { return _open; }

  // Takes as many of the bytes as fit, and returns their number; 0 if closed. next() must have returned everything sent
  // by `nowUs`.
  size_t write(uint64_t nowUs, const uint8_t *bytes, size_t size);

  // Takes the oldest character sent by `nowUs`; returns false without one.
  bool next(uint64_t nowUs, line::Character &character);

  // Takes the oldest character that began by `nowUs` and has not been taken here; returns false without one.
  bool begun(uint64_t nowUs, line::Character &character);

  // Returns the free places, as the sketch sees them; 0 if closed.
  int availableForWrite() const { return _open ? static_cast<int>(RingSize - _count) : 0; }

  // Returns true if all written bytes have been sent.
  bool idle() const { return _count == 0; }

  // Returns when the current packet is sent, and its places become free; 0 if idle.
  uint64_t packetEndUs() const { return idle() ? 0 : endUs(_packet); }

 private:
  void beginPacket(uint64_t fromNs);
  uint64_t endUs(size_t characters) const;

  bool _open = false;
  uint64_t _characterNs = 0;

  uint8_t _ring[RingSize] = {};
  size_t _first = 0;       // of the current packet
  size_t _count = 0;       // places taken
  size_t _packet = 0;      // characters in the current packet
  size_t _sent = 0;        // of these, already sent
  size_t _begun = 0;       // of these, returned by begun()
  uint64_t _packetNs = 0;  // when its first character began
  uint64_t _freeNs = 0;    // the wire is busy until then
};

}  // namespace host
