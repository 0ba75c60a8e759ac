// Plays a recording once.
#pragma once

#include <memory>
#include <utility>

#include "Line.h"
#include "Recording.h"

namespace line {

class RecordedLine : public Line {
 public:
  explicit RecordedLine(Recording recording)
      : RecordedLine(std::make_shared<const Recording>(std::move(recording))) {}

  // Several lines may play one recording.
  explicit RecordedLine(std::shared_ptr<const Recording> recording) : _characters(recording, &recording->characters) {}

  // The recording begins a moment after the sketch has opened the port: nobody wants to miss its beginning.
  void opened(uint64_t nowUs) override { _zeroUs = nowUs + LeadUs; }

  bool next(uint64_t nowUs, Character &character) override;

  uint64_t knownUs(uint64_t nowUs) const override;

  // A little later than its last character, so that the sketch can show what it has made of it.
  bool finished(uint64_t nowUs) const override;

 private:
  static constexpr uint64_t LeadUs = 1000;
  static constexpr uint64_t TailUs = 300000;

  const std::shared_ptr<const Characters> _characters;
  uint64_t _zeroUs = LeadUs;
  size_t _index = 0;
};

}  // namespace line
