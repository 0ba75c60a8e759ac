#include "cli/RepeatedFrames.h"

#include <algorithm>
#include <stdexcept>

namespace tool {

namespace {

constexpr uint64_t RowUs = 200000;  // period of rows without times: a sketch's and that of `sbus csv`

}  // namespace

RepeatedFrames::RepeatedFrames(std::string name, std::unique_ptr<TextInput> text, uint64_t periodUs,
                               uint32_t characterUs, uint64_t fromUs, uint64_t toUs)
    : _name(std::move(name)),
      _lines(std::make_unique<TextLines>(std::move(text))),
      _periodUs(periodUs),
      _characterUs(characterUs),
      _frameUs(fromUs),
      _toUs(toUs) {
  readRow();
  if (_newRow) {
    _row = *_newRow;
    readRow();
  }
  if (!_failure.empty()) {
    throw std::runtime_error(_failure);
  }
}

bool RepeatedFrames::next(uint64_t nowUs, line::Character &character) {
  if (_waiting.empty() && !_ended && _frameUs <= nowUs) {
    makeFrame();
  }
  if (_waiting.empty() || _waiting.front().endUs > nowUs) {
    return false;
  }
  character = _waiting.front();
  _waiting.pop_front();
  return true;
}

void RepeatedFrames::makeFrame() {
  if (_lines) {
    goTo(_frameUs);
  }
  _ended = _ended || (_toUs > 0 && _frameUs >= _toUs);
  if (_ended) {
    return;
  }
  const size_t channels = std::max<size_t>(_table.channels(), sbus::ProportionalCount);
  const size_t size = channels == sbus::ChannelCount24 ? sbus::FrameSize24 : sbus::FrameSize;
  line::appendFrames(_row, channels, _frameUs + size * uint64_t{_characterUs}, 0, _characterUs, _waiting);
  _frameUs += _periodUs;
}

// Selects the row that is valid at `us` in the table's time.
void RepeatedFrames::goTo(uint64_t us) {
  while (_newRow && _newUs <= us) {
    _row = *_newRow;
    readRow();
  }
  _ended = !_failure.empty() || (!_newRow && us >= _endUs);
}

void RepeatedFrames::readRow() {
  _newRow.reset();
  for (std::string line; readLine(line);) {
    const std::string wrong = !_lines->wrong().empty() ? _lines->wrong()
                              : _lines->isCut()        ? _table.cutLine(line)
                                                       : _table.line(line);
    if (!wrong.empty()) {
      _failure = _name + ":" + std::to_string(_lines->number()) + ": " + wrong;
      return;
    }
    if (_table.isRow()) {
      const uint64_t lastUs = _newUs;
      const uint64_t us = _table.row().us.value_or(_rows * RowUs);
      _zeroUs = _rows == 0 ? us : _zeroUs;
      _newUs = us - _zeroUs;
      _endUs = _newUs + (_rows == 0 ? RowUs : _newUs - lastUs);
      _rows++;
      _newRow = _table.row();
      return;
    }
  }
  if (_failure.empty() && _rows == 0) {
    _failure = _name + ": has no rows; rows as sbus csv prints them are expected";
  }
}

// Waits for the next line. Returns false at the end.
bool RepeatedFrames::readLine(std::string &line) {
  while (!_lines->take(line)) {
    if (_lines->atEnd()) {
      _failure = _lines->failure().empty() ? "" : _name + ": " + _lines->failure();
      return false;
    }
    _lines->read();
  }
  return true;
}

}  // namespace tool
