// Compares the frames of two lines by an Aligner: lost frames, delays, the first difference.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "line/compare/Aligner.h"
#include "line/compare/Delays.h"

namespace line {

// A time in which one source lost frames that the other has.
struct LostSpan {
  size_t side;  // the one that lost frames: 0 is the first source
  int64_t fromUs;
  int64_t toUs;
  unsigned long frames;
};

class Comparison {
 public:
  static constexpr size_t LongestMost = 20;

  struct Difference {
    int64_t us;
    std::string name;  // CH3, lost frame; empty: the frame is only in source `side`
    size_t side;
    std::array<unsigned, 2> values;
  };

  // Arrays of two are indexed by source.
  struct Counts {
    std::array<unsigned long, 2> frames{};
    std::array<unsigned long, 2> alone{};  // before the other line begins or after its end
    std::array<unsigned long, 2> lost{};
    std::array<unsigned long, 2> spans{};
    std::array<std::vector<LostSpan>, 2> longest;  // by frames, LongestMost at most
    std::array<unsigned long, 2> late{};           // not compared: see Alignment
    std::array<unsigned, 2> channels{};            // of the newest pair
    unsigned long same = 0;
    unsigned long different = 0;
    std::optional<Difference> first;
    Delays delays;
    bool areDelaysLate = true;  // all of them are of frames that came while the PC was late
  };

  // Calls `tell` with each span at its end.
  explicit Comparison(std::function<void(const LostSpan &)> tell);
  Comparison(const Comparison &) = delete;  // its aligner points to it
  Comparison &operator=(const Comparison &) = delete;

  // See Aligner.
  void put(size_t side, int64_t us, const Values &values, int64_t lateUs = 0);
  void knownUntil(size_t side, int64_t us) { _aligner.knownUntil(side, us); }

  // Takes the time of a character or of silence, from the first to the last: where a line without frames is known, it
  // has lost the other's.
  void heard(size_t side, int64_t us) {
    _lines[side].fromUs = std::min(_lines[side].fromUs, us);
    _lines[side].toUs = std::max(_lines[side].toUs, us);
  }
  void finish();

  const Aligner &aligner() const { return _aligner; }

  // Returns true if a pair of frames had the same contents.
  bool any() const { return _counts.delays.count() > 0; }

  const Counts &counts() const { return _counts; }

  // Return why frames may differ, in a sentence, or "": "A sends every 9.00 ms, B every 14.00 ms: ..."; of receivers
  // that scale the sticks differently the first channel with other ends, if hardly any frames are alike.
  std::string rates() const;
  std::string scales() const;
  std::string why() const;  // both

 private:
  struct Span {
    LostSpan span;
    bool isMissing;  // there was no frame
  };

  // What a line has, without failsafe.
  struct Line {
    Line() { least.fill(UINT16_MAX); }

    decltype(Values::raw) least, most{};  // of each channel
    size_t channels = 0;
    int64_t fromUs = INT64_MAX;  // of its characters
    int64_t toUs = INT64_MIN;
    std::vector<int64_t> without;  // the other's frames, in times of the first line, since this one has none
  };

  void take(int64_t us, const Alignment &found);
  void putPair(int64_t us, const Alignment &found);
  void putDelay(int64_t us, const Alignment &found);
  void lose(size_t side, int64_t us, bool isMissing);
  void loseKnown(size_t side);
  void end(size_t side);

  const std::function<void(const LostSpan &)> _tell;
  Aligner _aligner;
  std::array<Line, 2> _lines;
  Counts _counts;
  std::array<std::optional<Span>, 2> _open;
  bool _anyPair = false;
};

}  // namespace line
