#include "VcdWriter.h"

namespace line {

std::string VcdWriter::put(const Character &character) {
  std::string text;
  const uint32_t bitUs = _settings.bitNs() / 1000;
  uint64_t us = character.endUs - _settings.characterUs();
  if (!_begun) {
    const char idle = _settings.polarity == Polarity::Uninverted ? '1' : '0';
    text = "$comment S.Bus, " + line::text(_settings) + " $end\n$timescale 1 us $end\n$scope module sbus $end\n" +
           "$var wire 1 ! SBUS $end\n$upscope $end\n$enddefinitions $end\n#0\n" + idle + "!\n";
    _laterUs = us == 0 ? _settings.characterUs() : 0;
    _begun = true;
  }
  us += _laterUs;
  const bool parity = isOdd(character.value) != character.bad;
  const unsigned active = 1u | (~(character.value | static_cast<unsigned>(parity) << 8) & 0x1FF) << 1;
  for (unsigned i = 0; i < _settings.format.bits(); i++, us += bitUs) {
    level(us, (active >> i & 1) != 0, text);
  }
  _endUs = us;
  return text;
}

std::string VcdWriter::finish() const {
  return _begun ? "#" + std::to_string(_endUs + _settings.characterUs()) + "\n" : "";
}

void VcdWriter::level(uint64_t us, bool active, std::string &text) {
  if (active != _active) {
    const bool high = active == (_settings.polarity != Polarity::Uninverted);
    text += "#" + std::to_string(us) + (high ? "\n1!\n" : "\n0!\n");
    _active = active;
  }
}

}  // namespace line
