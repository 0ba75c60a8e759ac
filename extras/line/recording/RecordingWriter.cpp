#include "line/recording/RecordingWriter.h"

#include <algorithm>

#include "line/recording/WallTime.h"

namespace line {

namespace {

// Each frame gets its own line, even if the next one follows at once, and no line is too long for a reader.
constexpr unsigned LineMax = sbus::FrameSize;

}  // namespace

void RecordingWriter::comment(const std::string &text) {
  endLine();
  _done += "# " + text + '\n';
}

void RecordingWriter::began(int64_t us) {
  comment(std::string(BeganText) + wallTime(us));
}

void RecordingWriter::opened(const LineSettings &settings) {
  if (_opened && settings == _settings) {
    return;
  }
  _opened = true;
  _settings = settings;
  comment(text(settings));
}

void RecordingWriter::put(const Character &character) {
  const uint64_t earliestUs = _begun ? _lastEndUs + _settings.characterUs() : 0;
  const uint64_t endUs = std::max(character.endUs, earliestUs);
  if (endUs != earliestUs || character.lateUs != _lateUs) {
    endLine();
  }
  if (_onLine == 0) {
    _line = std::to_string(static_cast<int64_t>(endUs) + _zeroUs) + (character.lateUs == 0 ? "" : "~" + std::to_string(character.lateUs));
    _lateUs = character.lateUs;
  }
  constexpr char Digits[] = "0123456789ABCDEF";
  _line += ' ';
  _line += Digits[character.value >> 4];
  _line += Digits[character.value & 0xF];
  _line += character.bad ? "!" : "";
  _lastEndUs = endUs;
  _begun = true;
  if (++_onLine == LineMax) {
    endLine();
  }
}

void RecordingWriter::endLine() {
  if (_onLine != 0) {
    _done += _line + '\n';
    _onLine = 0;
  }
}

}  // namespace line
