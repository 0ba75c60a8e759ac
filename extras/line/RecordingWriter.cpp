#include "RecordingWriter.h"

namespace line {

namespace {

// So a frame has a line of its own even if the next one follows at once, and no line is too long for a reader.
constexpr unsigned LineMax = sbus::FrameSize;

}  // namespace

void RecordingWriter::opened(const LineSettings &settings) {
  if (_opened && settings == _settings) {
    return;
  }
  endLine();
  _opened = true;
  _settings = settings;
  _out << "# " << text(settings) << '\n';
}

void RecordingWriter::put(const Character &character) {
  if (_onLine == LineMax || character.endUs != _lastEndUs + _settings.characterUs()) {
    endLine();
  }
  if (_onLine == 0) {
    _out << character.endUs;
  }
  constexpr char Digits[] = "0123456789ABCDEF";
  _out << ' ' << Digits[character.value >> 4] << Digits[character.value & 0xF];
  _lastEndUs = character.endUs;
  _onLine++;
}

void RecordingWriter::endLine() {
  if (_onLine != 0) {
    _out << '\n';
    _onLine = 0;
  }
}

}  // namespace line
