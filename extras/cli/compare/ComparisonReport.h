// Counts what `sbus compare` has found, and says it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/compare/Aligner.h"
#include "cli/compare/Delays.h"

namespace tool {

// A time in which one source has lost what the other has.
struct LostSpan {
  size_t side;  // that lost it: 0 is the first source
  int64_t fromUs;
  int64_t toUs;
  unsigned long frames;

  std::string json() const;
};

class ComparisonReport {
 public:
  // Calls `tell` with each span when it has ended.
  explicit ComparisonReport(std::function<void(const LostSpan &)> tell) : _tell(std::move(tell)) {}

  void put(int64_t us, const Finding &finding);
  void finish();

  // Returns true if a pair of frames had the same contents.
  bool any() const { return _delays.count() > 0; }

  // `names`: of the sources. `isByContents`: as Aligner's.
  std::string text(const std::array<std::string, 2> &names, bool isByContents) const;
  std::string json(bool isByContents) const;

 private:
  struct Difference {
    int64_t us;
    std::string name;  // CH3, lost frame; empty: the frame is only in source `side`
    size_t side;
    std::array<unsigned, 2> values;
  };
  struct Span {
    LostSpan span;
    bool isMissing;  // no frame came
  };

  void putPair(int64_t us, const Finding &finding);
  void lose(size_t side, int64_t us, bool isMissing);
  void end(size_t side);
  std::string differenceText() const;
  std::string lostText(size_t side) const;

  const std::function<void(const LostSpan &)> _tell;
  std::array<unsigned long, 2> _frames{};
  std::array<unsigned long, 2> _alone{};  // before the other's first frame or after its last
  std::array<unsigned long, 2> _lost{};
  std::array<unsigned long, 2> _spans{};
  std::array<std::vector<LostSpan>, 2> _longest;
  std::array<std::optional<Span>, 2> _open;
  unsigned long _same = 0;
  unsigned long _different = 0;
  bool _anyPair = false;
  std::optional<Difference> _first;
  Delays _delays;
};

}  // namespace tool
