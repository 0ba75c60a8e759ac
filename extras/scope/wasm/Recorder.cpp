#include "Recorder.h"

#include <algorithm>

namespace scope {

void Recorder::begin(const line::LineSettings &settings) {
  _on = true;
  _characterUs = settings.characterUs();
  _writer = line::RecordingWriter();
  _writer.opened(settings);
}

// USB may have brought a frame in two bursts: on the line it was one.
void Recorder::put(const line::Stretch &stretch) {
  if (!_on) {
    return;
  }
  uint64_t afterUs = stretch.characters.size() * _characterUs;
  for (line::Character character : stretch.characters) {
    afterUs -= _characterUs;
    if (stretch.isFrame()) {
      character.endUs = stretch.endUs() - std::min(stretch.endUs(), afterUs);
    }
    _writer.put(character);
  }
}

void Recorder::end() {
  if (_on) {
    _writer.finish();
    _on = false;
  }
}

}  // namespace scope
