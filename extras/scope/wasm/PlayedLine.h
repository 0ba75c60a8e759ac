// A recording that can be wound back.
#pragma once

#include <utility>

#include "line/Line.h"
#include "line/Recording.h"

namespace scope {

class PlayedLine : public line::Line {
 public:
  // It begins at `zeroUs`.
  PlayedLine(line::Recording recording, uint64_t zeroUs) : _recording(std::move(recording)), _zeroUs(zeroUs) {}

  bool next(uint64_t nowUs, line::Character &character) override {
    if (atEnd() || _zeroUs + _recording.characters[_index].endUs > nowUs) {
      return false;
    }
    character = _recording.characters[_index++];
    character.endUs += _zeroUs;
    return true;
  }

  uint64_t knownUs(uint64_t nowUs) const override {
    return nowUs < _zeroUs ? 0 : _zeroUs + _recording.characters.knownUs(_index, nowUs - _zeroUs);
  }

  void rewind() { _index = 0; }
  bool atEnd() const { return _index == _recording.characters.size(); }
  uint64_t lengthUs() const { return _zeroUs + _recording.characters.back().endUs; }

 private:
  line::Recording _recording;
  const uint64_t _zeroUs;
  size_t _index = 0;
};

}  // namespace scope
