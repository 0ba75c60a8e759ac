// A program on a PC that reads a USB adapter.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "line/Observer.h"
#include "line/ports/PortReads.h"
#include "line/recording/RecordingWriter.h"
#include "support/Adapter.h"

using line::Character;
using line::Stretch;

// A program that reads the adapter by poll(): one read in 20 finds it late, by up to `stallUs`.
class Program {
 public:
  Program(uint32_t latencyUs, uint32_t stallUs, line::Random &random)
      : _reads(line::CharacterUs, latencyUs), _adapter(latencyUs, random), _stallUs(stallUs), _random(random) {}

  void put(const Character &character) {
    _adapter.put(character, [this](const Read &read) { arrived(read); });
  }

  // Takes the time up to which there are no further characters.
  void idleUntil(uint64_t us) {
    _adapter.runTo(us, [this](const Read &read) { arrived(read); });
    catchUp(us);
    lookUntil(us);
  }

  line::Observer observer;
  line::RecordingWriter recorder;

 private:
  void arrived(const Read &brought) {
    catchUp(brought.us);
    if (_busyUntilUs > brought.us) {
      _waiting.insert(_waiting.end(), brought.characters.begin(), brought.characters.end());
      return;
    }
    lookUntil(brought.us);
    read(brought.us, brought.characters);
    _busyUntilUs = _stallUs != 0 && _random.below(20) == 0 ? brought.us + _random.below(_stallUs) : 0;
  }

  // Reads the bytes received while the program was busy.
  void catchUp(uint64_t us) {
    if (!_waiting.empty() && _busyUntilUs <= us) {
      read(_busyUntilUs, _waiting);
      _waiting.clear();
    }
    _lookUs = std::max(_lookUs, std::min(us, _busyUntilUs));
  }

  void read(uint64_t us, const std::vector<Character> &characters) {
    _lookUs = us;
    _reads.begin(characters.size(), us);
    for (const Character &sent : characters) {
      const Character character = _reads.next(sent.value, sent.bad);
      recorder.put(character);
      observer.put(character);
    }
  }

  // Its poll() returns without bytes.
  void lookUntil(uint64_t us) {
    while ((_lookUs += static_cast<uint64_t>(_reads.knownAfterMs()) * 1000) < us) {
      _reads.empty(_lookUs);
      observer.idleUntil(_reads.knownUs());
    }
  }

  line::PortReads _reads;
  Adapter _adapter;
  uint32_t _stallUs;
  line::Random &_random;
  uint64_t _lookUs = 0;
  uint64_t _busyUntilUs = 0;
  std::vector<Character> _waiting;
};
