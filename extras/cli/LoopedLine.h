// Plays a file repeatedly.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "line/Line.h"
#include "line/Observer.h"

namespace tool {

// Each pass follows the one before it at the period of the line's frames, and begins and ends with a whole frame.
class LoopedLine : public line::Line {
 public:
  // `open` returns the line, from `fromUs` of its own time on. Without `hasFrames` each character is repeated.
  LoopedLine(std::function<std::unique_ptr<line::Line>()> open, uint64_t fromUs, uint32_t characterUs, bool hasFrames)
      : _open(std::move(open)), _fromUs(fromUs), _characterUs(characterUs), _hasFrames(hasFrames) {
    beginPass();
  }

  bool next(uint64_t nowUs, line::Character &character) override;
  uint64_t knownUs(uint64_t nowUs) const override;
  std::string failure() const override { return _line->failure().empty() ? _failure : _line->failure(); }
  std::string news() override { return _line->news(); }

 private:
  void beginPass();
  void endPass();
  void fill(uint64_t nowUs);
  void take(const line::Stretch &stretch);
  void play(const std::vector<line::Character> &characters);
  uint64_t periodUs() const;

  const std::function<std::unique_ptr<line::Line>()> _open;
  const uint64_t _fromUs;
  const uint32_t _characterUs;
  const bool _hasFrames;
  std::unique_ptr<line::Line> _line;
  std::optional<line::Observer> _observer;
  uint64_t _readUs = 0;                   // the pass has been read up to this time of its own
  std::optional<int64_t> _shiftUs;        // from its time to the program's; none before its first frame
  std::optional<uint64_t> _dueUs;         // when its first frame ends; none in the first pass
  line::Stretch::Kind _first{};           // the kind of its first frame
  std::vector<uint64_t> _endsUs;          // the ends of its newest frames of this kind, in the program's time
  std::vector<line::Character> _between;  // what has come since the last frame
  std::deque<line::Character> _waiting;
  std::string _failure;
};

}  // namespace tool
