// Plays a recording once.
#pragma once

#include <algorithm>
#include <memory>
#include <utility>

#include "line/Line.h"
#include "line/recording/Recording.h"

namespace line {

class RecordedLine : public Line {
 public:
  // The recording begins `leadUs` after the port is opened: otherwise a sketch would miss its first character.
  explicit RecordedLine(Recording recording, uint64_t leadUs = 0)
      : RecordedLine(std::make_shared<const Recording>(std::move(recording)), leadUs) {}

  // Several lines may share a recording.
  explicit RecordedLine(std::shared_ptr<const Recording> recording, uint64_t leadUs = 0)
      : _characters(recording, &recording->characters),
        _endUs(std::max(recording->endUs, recording->characters.empty() ? 0 : recording->characters.back().endUs)),
        _leadUs(leadUs) {}

  void opened(uint64_t nowUs) override { _zeroUs = nowUs + _leadUs; }

  bool next(uint64_t nowUs, Character &character) override {
    if (_index == _characters->size() || _zeroUs + (*_characters)[_index].endUs > nowUs) {
      return false;
    }
    character = (*_characters)[_index++];
    character.endUs += _zeroUs;
    return true;
  }

  uint64_t knownUs(uint64_t nowUs) const override {
    return nowUs < _zeroUs ? 0 : _zeroUs + _characters->knownUs(_index, nowUs - _zeroUs);
  }

  // Returns true a little after the end, so that a sketch can still print its values.
  bool finished(uint64_t nowUs) const override { return nowUs >= _zeroUs + _endUs + TailUs; }

 private:
  const std::shared_ptr<const Characters> _characters;
  const uint64_t _endUs;  // of the last character, or of the capture
  uint64_t _leadUs;
  uint64_t _zeroUs = 0;
  size_t _index = 0;
};

}  // namespace line
