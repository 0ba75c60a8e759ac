#include "TextRecorder.h"

#include <algorithm>

namespace scope {

void TextRecorder::begin(const line::LineSettings &settings, uint64_t nowUs) {
  _on = true;
  _zeroUs = nowUs;
  _characterUs = settings.characterUs();
  _writer = line::RecordingWriter();
  _writer.opened(settings);
}

// The characters of a read may have been on the line a little before.
void TextRecorder::put(line::Character character) {
  if (_on) {
    character.endUs = std::max(character.endUs, _zeroUs + _characterUs) - _zeroUs;
    _writer.put(character);
  }
}

void TextRecorder::end() {
  if (_on) {
    _writer.finish();
    _on = false;
  }
}

}  // namespace scope
