/// @file
/// Recognises packets of one length that are not frames: those of a sender with a mistake, or of another protocol.
#pragma once

#include <stdint.h>

#include "Diagnosis.h"

namespace sbus {

/// The form of a packet: bytes between two gaps.
struct PacketForm {
  uint8_t size;   ///< bytes; 255 means 255 or more
  uint8_t first;  ///< its first byte
  uint8_t flags;  ///< byte 23, where a frame of 16 channels has its flags; undefined in a shorter packet
  uint8_t last;   ///< its last byte
};

/// Takes a line's bytes and the gaps between them. Only a program that diagnoses a line needs it: 14 bytes of RAM.
class PacketShape {
 public:
  /// As many packets of one length and with one first byte; of a noisy line whose frames have lost a byte, 12 in a row
  /// come once in 100000 frames.
  static constexpr uint8_t PacketsMin = 12;

  /// Takes the next byte.
  void put(uint8_t byte);

  /// Takes a gap: a packet ends. Further calls at the same place change nothing.
  void gap();

  /// Takes note that bytes are missing before the next one, or wrong.
  void spoil();

  /// Returns WrongPackets, or UnusedFlags if only the flags are wrong; NoSignal if no such packets come, or not yet.
  Finding found() const { return _found; }

  /// Returns the form of these packets: of the newest. Undefined before found().
  const PacketForm &form() const { return _usual; }

 private:
  Finding fault() const;

  PacketForm _packet = PacketForm();  // as far as it has come
  PacketForm _usual = PacketForm();
  uint8_t _end = 0;        // its byte 24
  bool _endsAs24 = false;  // bytes 34 and 35 are flags and an end byte
  bool _isSpoilt = true;   // its beginning is missing, or a byte is wrong
  uint8_t _run = 0;        // packets of the usual form
  Finding _found = Finding::NoSignal;
};

}  // namespace sbus
