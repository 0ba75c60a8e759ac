// A recording that can be wound back.
#pragma once

#include <utility>

#include "line/Line.h"
#include "line/recording/Recording.h"

namespace scope {

class PlayedLine : public line::Line {
 public:
  explicit PlayedLine(line::Recording recording) : _recording(std::move(recording)) {}

  bool next(uint64_t nowUs, line::Character &character) override {
    if (atEnd() || _recording.characters[_index].endUs > nowUs) {
      return false;
    }
    character = _recording.characters[_index++];
    return true;
  }

  uint64_t knownUs(uint64_t nowUs) const override {
    return _recording.characters.knownUs(_index, nowUs);
  }

  void rewind() { _index = 0; }
  bool atEnd() const { return _index == _recording.characters.size(); }
  uint64_t lengthUs() const { return _recording.characters.back().endUs; }

 private:
  line::Recording _recording;
  size_t _index = 0;
};

}  // namespace scope
