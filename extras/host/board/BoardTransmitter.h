// How the board sends: the path of the bytes from the sketch's write() to the wire.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>

#include "line/Line.h"

namespace host {

// 64 bytes wait; on the wire their characters are back to back, and a place becomes free when its character has been
// sent. (The board gives places back in packets of up to 32.)
//
// Time comes in as an argument and must not go backwards.
class BoardTransmitter {
 public:
  static constexpr size_t BufferSize = 64;

  // Opens with an empty buffer, for characters of this length. Like close(), loses bytes still in it.
  void open(uint64_t characterNs) {
    close();
    _open = true;
    _characterNs = characterNs;
  }
  void close() {
    _open = false;
    _waiting.clear();
    _begun = 0;
    _freeNs = 0;
  }
  bool isOpen() const { return _open; }

  // Takes as many of the bytes as fit, and returns their number; 0 if closed. next() must have returned everything sent
  // by `nowUs`.
  size_t write(uint64_t nowUs, const uint8_t *bytes, size_t size) {
    const size_t taken = std::min(size, static_cast<size_t>(availableForWrite()));
    for (size_t i = 0; i < taken; i++) {
      _freeNs = std::max(nowUs * NsPerUs, _freeNs) + _characterNs;
      _waiting.push_back({_freeNs, bytes[i]});
    }
    return taken;
  }

  // Takes the oldest character sent by `nowUs`; returns false without one.
  bool next(uint64_t nowUs, line::Character &character) {
    if (idle() || nextUs() > nowUs) {
      return false;
    }
    character = toCharacter(_waiting.front());
    _waiting.pop_front();
    _begun -= _begun != 0;
    return true;
  }

  // Takes the oldest character that began by `nowUs` and has not been taken here; returns false without one.
  bool begun(uint64_t nowUs, line::Character &character) {
    if (_begun >= _waiting.size() || _waiting[_begun].endNs - _characterNs > nowUs * NsPerUs) {
      return false;
    }
    character = toCharacter(_waiting[_begun++]);
    return true;
  }

  // Returns the free places, as the sketch sees them; 0 if closed.
  int availableForWrite() const { return _open ? static_cast<int>(BufferSize - _waiting.size()) : 0; }

  // Returns true if all written bytes have been sent.
  bool idle() const { return _waiting.empty(); }

  // Returns when the next character is sent, and its place becomes free; 0 if idle.
  uint64_t nextUs() const { return idle() ? 0 : toCharacter(_waiting.front()).endUs; }

 private:
  static constexpr uint64_t NsPerUs = 1000;

  struct Waiting {
    uint64_t endNs;
    uint8_t value;
  };

  static line::Character toCharacter(const Waiting &waiting) {
    line::Character character;
    character.endUs = (waiting.endNs + NsPerUs - 1) / NsPerUs;
    character.value = waiting.value;
    return character;
  }

  bool _open = false;
  uint64_t _characterNs = 0;
  uint64_t _freeNs = 0;  // the wire is busy until then
  std::deque<Waiting> _waiting;
  size_t _begun = 0;  // of these, returned by begun()
};

}  // namespace host
