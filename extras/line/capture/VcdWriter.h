// The wire of a line as a value change dump, so that a logic analyser's software shows it.
#pragma once

#include <cstdint>
#include <string>

#include "line/uart/Levels.h"

namespace line {

// Characters go in, in their order, and text comes out. A bad character gets a wrong parity bit.
class VcdWriter {
 public:
  // 100000 or 200000 baud: a bit then lasts whole microseconds.
  explicit VcdWriter(const LineSettings &settings) : _settings(settings) {}

  // A first character that begins at the time 0 or before has no level before its edge: then all are later, so that it
  // begins after a character's time.
  std::string put(Character character);

  // The line stays idle for a character.
  std::string finish() const;

 private:
  const LineSettings _settings;
  uint64_t _laterUs = 0;
  uint64_t _endUs = 0;  // of the last character
  bool _begun = false;
  bool _high = false;
};

}  // namespace line
