// Writes the wire of a line as a value change dump, for a logic analyser's software.
#pragma once

#include <cstdint>
#include <string>

#include "line/uart/Levels.h"

namespace line {

// Takes characters in order, and returns text. A character with an error gets a wrong parity bit.
class VcdWriter {
 public:
  // Needs 100000 or 200000 baud, so that a bit lasts whole microseconds.
  explicit VcdWriter(const LineSettings &settings) : _settings(settings) {}

  // Takes the next character. If the first one begins at time 0 or earlier, there is no room for a level before its
  // edge: then all characters are shifted so that it begins after a character's time.
  std::string put(Character character);

  // Ends the text: the line stays idle for a character's time.
  std::string finish() const;

 private:
  const LineSettings _settings;
  uint64_t _laterUs = 0;
  uint64_t _endUs = 0;  // the last character's end
  bool _begun = false;
  bool _high = false;
};

}  // namespace line
