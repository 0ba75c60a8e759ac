// Plays a recording once.
#pragma once

#include <utility>

#include "Line.h"
#include "Recording.h"

namespace line {

class RecordedLine : public Line {
 public:
  static constexpr uint64_t LeadUs = 1000;

  explicit RecordedLine(Recording recording) : _recording(std::move(recording)) {}

  // The recording begins a moment after the sketch has opened the port: nobody wants to miss its beginning.
  void opened(uint64_t nowUs) override { _zeroUs = nowUs + LeadUs; }

  bool next(uint64_t nowUs, Character &character) override;

  uint64_t knownUs(uint64_t nowUs) const override;

  // A little later than its last character, so that the sketch can show what it has made of it.
  bool finished(uint64_t nowUs) const override;

 private:
  static constexpr uint64_t TailUs = 300000;

  Recording _recording;
  uint64_t _zeroUs = LeadUs;
  size_t _index = 0;
};

}  // namespace line
