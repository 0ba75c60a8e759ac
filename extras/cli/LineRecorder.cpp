#include "cli/LineRecorder.h"

namespace tool {

namespace {

constexpr size_t TextMax = 4096;  // bytes of a text without rows

}  // namespace

LineRecorder::LineRecorder(const std::string &title, const line::LineSettings &settings, bool isCopy, bool hasTimes,
                           std::optional<int64_t> startUs, int64_t zeroUs, const Put &write)
    : _title("sbus " + title), _settings(settings), _hasTimes(hasTimes), _startUs(startUs), _write(write) {
  _observer.reset(0, settings.characterUs());
  _writer.setZero(zeroUs);
  if (isCopy) {
    begin(Kind::Characters);
  }
}

void LineRecorder::put(const line::Character &character) {
  _lastEndUs = character.endUs;
  _observer.put(character);
  const bool line = _rows.put(character);
  if (_kind == Kind::Rows) {
    writeRow(line);
  } else if (_kind == Kind::Characters) {
    _writer.put(character);
  } else {
    _first.push_back(character);
    decide();
  }
  flush();
}

void LineRecorder::idleUntil(uint64_t us) {
  if (us > _lastEndUs + 2 * uint64_t{_settings.characterUs()}) {
    _writer.finish();
    flush();
  }
}

void LineRecorder::finish() {
  if (_kind == Kind::Unknown && !_first.empty()) {
    begin(Kind::Characters);
  }
  _writer.finish();
  flush();
}

std::string LineRecorder::summary() {
  if (_kind == Kind::Rows) {
    return std::to_string(_rowCount) + " rows of CSV";
  }
  _observer.finish();
  return std::to_string(_observer.characters()) + " characters (" + std::to_string(_observer.characterErrors()) +
         " with errors), " + _observer.frames();
}

void LineRecorder::decide() {
  if (_rows.recognised()) {
    begin(Kind::Rows);
  } else if (_rows.garbled() > 0 || _first.size() == TextMax) {
    begin(Kind::Characters);
  }
}

void LineRecorder::begin(Kind kind) {
  _kind = kind;
  if (kind == Kind::Characters) {
    _writer.comment(_title);
    if (!_hasTimes) {
      _writer.comment("times are not known: those below are not the line's");
    }
    if (_startUs) {
      _writer.began(*_startUs);
    }
    _writer.opened(_settings);
    for (const line::Character &character : _first) {
      _writer.put(character);
    }
  } else {
    _write("# " + _title + ": rows of CSV as the sketch printed them, not S.Bus\n");
    _columns = _rows.row().size();
    _rows = line::CsvRows();
    for (const line::Character &character : _first) {
      writeRow(_rows.put(character));
    }
  }
  _first.clear();
}

// Leaves out a row without its beginning.
void LineRecorder::writeRow(bool complete) {
  if (complete && _rows.isRow() && _rows.row().size() == _columns) {
    std::string text;
    for (const line::CsvField &field : _rows.row()) {
      text += (text.empty() ? "" : ",") + field.text;
    }
    _write(text + "\r\n");
    _rowCount++;
  }
}

void LineRecorder::flush() {
  const std::string lines = _writer.take();
  if (!lines.empty()) {
    _write(lines);
  }
}

}  // namespace tool
