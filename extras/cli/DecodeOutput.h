// Prints the table of `sbus decode`.
#pragma once

#include <string>
#include <vector>

#include "line/Observer.h"
#include "line/file/CaptureFile.h"

namespace tool {

class DecodeOutput {
 public:
  // Shows each character if `characters` is true; otherwise frames, and the discarded bytes.
  explicit DecodeOutput(bool characters) : _showsCharacters(characters) {}

  // Takes the wire, once it has been found.
  void begin(const line::WireDecoder &wire);

  void character(const line::WireCharacter &character);

  // Takes a stretch of the line with its characters as they were on the wire. `values`: the frame's, if it is one.
  void stretch(const line::Stretch &stretch, const std::vector<line::WireCharacter> &characters,
               const line::Values &values);

  // Returns how long a character takes, once the wire is found.
  int64_t characterNs() const { return _characterNs; }

  void end(const std::string &name, const line::CaptureEnd &capture, const line::Observer &observer) const;

 private:
  int64_t endNs(const line::WireCharacter &character) const { return character.startNs + _characterNs; }
  void frame(const line::Stretch &stretch, int64_t endNs, const line::Values &values);
  void noFrame(const line::Stretch &stretch, const std::vector<line::WireCharacter> &characters);
  // Returns "parity error, the parity bit is 1 on the wire, 0 is expected".
  std::string fault(const line::WireCharacter &character) const;

  const bool _showsCharacters;
  bool _isMeasured = true;  // the capture holds the wire, not characters decoded by an analyser
  bool _inverted = true;
  int64_t _characterNs = 0;
  size_t _columns = 0;  // of the newest frame: a change starts a new heading
  unsigned long _characters = 0;
  unsigned long _parityErrors = 0;
  unsigned long _framingErrors = 0;
};

}  // namespace tool
