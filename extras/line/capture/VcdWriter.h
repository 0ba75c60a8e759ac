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
  std::string put(Character character) {
    std::string text;
    if (!_begun) {
      _high = _settings.idleHigh();
      text = "$comment S.Bus, " + line::text(_settings) + " $end\n$timescale 1 us $end\n$scope module sbus $end\n" +
             "$var wire 1 ! SBUS $end\n$upscope $end\n$enddefinitions $end\n#0\n" + (_high ? "1!\n" : "0!\n");
      const uint64_t characterUs = _settings.characterUs();
      _laterUs = character.endUs <= characterUs ? 2 * characterUs - character.endUs : 0;
      _begun = true;
    }
    character.endUs += _laterUs;
    _endUs = character.endUs;
    encode(character, _settings, [&](int64_t ns, bool high) {
      if (high != _high) {
        text += "#" + std::to_string(ns / 1000) + (high ? "\n1!\n" : "\n0!\n");
        _high = high;
      }
    });
    return text;
  }

  // Ends the text: the line stays idle for a character's time.
  std::string finish() const { return _begun ? "#" + std::to_string(_endUs + _settings.characterUs()) + "\n" : ""; }

 private:
  const LineSettings _settings;
  uint64_t _laterUs = 0;
  uint64_t _endUs = 0;  // the last character's end
  bool _begun = false;
  bool _high = false;
};

}  // namespace line
