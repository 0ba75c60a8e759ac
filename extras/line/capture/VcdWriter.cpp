#include "line/capture/VcdWriter.h"

namespace line {

std::string VcdWriter::put(Character character) {
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

std::string VcdWriter::finish() const {
  return _begun ? "#" + std::to_string(_endUs + _settings.characterUs()) + "\n" : "";
}

}  // namespace line
