#include "RecordingText.h"

namespace line {

namespace {

// So a frame has a line of its own even if the next one follows at once, and no line is too long for a reader.
constexpr unsigned LineMax = sbus::FrameSize;

}  // namespace

void RecordingText::opened(const LineSettings &settings, std::string &text) {
  if (_opened && settings == _settings) {
    return;
  }
  endLine(text);
  _opened = true;
  _settings = settings;
  text += "# " + line::text(settings) + '\n';
}

void RecordingText::put(const Character &character, std::string &text) {
  if (_onLine == LineMax || character.endUs != _lastEndUs + _settings.characterUs()) {
    endLine(text);
  }
  if (_onLine == 0) {
    text += std::to_string(character.endUs);
  }
  constexpr char Digits[] = "0123456789ABCDEF";
  text += ' ';
  text += Digits[character.value >> 4];
  text += Digits[character.value & 0xF];
  _lastEndUs = character.endUs;
  _onLine++;
}

void RecordingText::endLine(std::string &text) {
  if (_onLine != 0) {
    text += '\n';
    _onLine = 0;
  }
}

}  // namespace line
