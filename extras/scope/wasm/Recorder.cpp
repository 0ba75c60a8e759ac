#include "Recorder.h"

#include <algorithm>

namespace scope {

void Recorder::begin(const line::LineSettings &settings) {
  _on = true;
  _characterUs = settings.characterUs();
  _lastEndUs = 0;
  _text.clear();
  _writer = line::RecordingText();
  _writer.opened(settings, _text);
}

// USB may have brought a frame in two bursts: on the line it was one. Bad characters are none of a recording.
void Recorder::put(const line::Stretch &stretch) {
  if (!_on) {
    return;
  }
  const auto &characters = stretch.characters;
  for (size_t i = 0; i < characters.size(); i++) {
    line::Character character = characters[i];
    if (stretch.isFrame()) {
      const uint64_t afterUs = (characters.size() - 1 - i) * _characterUs;
      character.endUs = stretch.endUs() - std::min(stretch.endUs(), afterUs);
    }
    if (!character.bad) {
      character.endUs = std::max(character.endUs, _lastEndUs + _characterUs);
      _lastEndUs = character.endUs;
      _writer.put(character, _text);
    }
  }
}

void Recorder::end() {
  if (_on) {
    _writer.finish(_text);
    _on = false;
  }
}

}  // namespace scope
