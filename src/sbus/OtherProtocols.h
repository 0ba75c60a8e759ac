/// @file
/// Recognises what is not S.Bus: packets of other receivers, by their checksums and by what follows them.
#pragma once

#include <stdint.h>

#include "Diagnosis.h"

namespace sbus {

/// Takes a port's bytes, and names the protocol. Only a program that diagnoses a line needs it: 120 bytes of RAM.
class OtherProtocols {
 public:
  static constexpr uint8_t PacketsMin = 4;  ///< that follow each other without a byte between: random bytes never do

  /// Takes the next byte.
  void put(uint8_t byte);

  /// Returns IBus, Crsf, FPort, Sumd, Spektrum or Dbus; NoSignal if it is none of them, or not known yet.
  Finding found() const { return _found; }

 private:
  static constexpr uint8_t Size = 72;  // the longest packet, SUMD's of 32 channels, has 69 bytes
  static constexpr uint8_t Kinds = 5;

  struct Chain {
    uint16_t end;   // where the newest packet ended
    uint8_t count;  // of packets, one after the other
  };

  // Returns a byte, counted back from the newest. (Without a division: an AVR has 120 us for all that put() does.)
  uint8_t at(uint8_t back) const {
    const uint8_t place = static_cast<uint8_t>(_next + Size - 1 - back);
    return _bytes[place < Size ? place : place - Size];
  }
  uint8_t endOfIBus() const;
  bool endsCrsf(uint8_t size) const;
  bool endsSumd(uint8_t size) const;
  void noteChecked();
  uint8_t endOfFPort() const;
  uint8_t endOfDbus() const;
  bool isSpektrum() const;
  uint16_t identifiers(uint8_t first) const;
  void note(uint8_t kind, Finding finding, uint8_t size);

  uint8_t _bytes[Size] = {};
  uint8_t _next = 0;
  uint16_t _count = 0;
  Chain _chains[Kinds] = {};
  Finding _found = Finding::NoSignal;
};

}  // namespace sbus
