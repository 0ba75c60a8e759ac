#include "Recorder.h"

namespace scope {

void Recorder::begin(const line::LineSettings &settings) {
  _on = true;
  _writer = line::RecordingWriter();
  _writer.opened(settings);
}

void Recorder::put(const line::Stretch &stretch) {
  for (const line::Character &character : stretch.characters) {
    if (_on) {
      _writer.put(character);
    }
  }
}

void Recorder::end() {
  if (_on) {
    _writer.finish();
    _on = false;
  }
}

}  // namespace scope
