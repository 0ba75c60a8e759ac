#include "line/compare/Comparison.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "line/Format.h"

namespace line {

namespace {

bool isFlagged(const Values &values) { return values.lostFrame || values.failsafe; }

}  // namespace

Comparison::Comparison(std::function<void(const LostSpan &)> tell)
    : _tell(std::move(tell)), _aligner([this](int64_t us, const Alignment &found) { take(us, found); }) {}

void Comparison::put(size_t side, int64_t us, const Values &values, int64_t lateUs) {
  Line &line = _lines[side];
  line.channels = values.count;
  for (size_t i = 0; i < values.count && !values.failsafe; i++) {
    line.least[i] = std::min(line.least[i], values.raw[i]);
    line.most[i] = std::max(line.most[i], values.raw[i]);
  }
  _aligner.put(side, us, values, lateUs);
}

void Comparison::take(int64_t us, const Alignment &found) {
  if (found.kind == Alignment::Kind::Pair) {
    putPair(us, found);
    return;
  }
  _counts.frames[found.side]++;
  if (!_anyPair) {
    _lines[1 - found.side].without.push_back(us);
    return;
  }
  if (found.isLate) {
    _counts.late[found.side]++;
    return;
  }
  lose(1 - found.side, us, true);
}

void Comparison::putPair(int64_t us, const Alignment &found) {
  const Values &a = *found.values[0], &b = *found.values[1];
  _counts.frames[0]++;
  _counts.frames[1]++;
  if (found.isLate && (!found.isSameContent || isFlagged(a) != isFlagged(b))) {
    _counts.late[0]++;
    _counts.late[1]++;
    return;
  }
  if (!std::exchange(_anyPair, true)) {
    for (const size_t side : {size_t{0}, size_t{1}}) {
      loseKnown(side);
      end(side);
    }
  }
  _counts.channels = {a.count, b.count};
  if (found.isSameContent) {
    putDelay(us, found);
  }
  if (isFlagged(a) != isFlagged(b)) {
    lose(isFlagged(a) ? 0 : 1, us, false);
    return;
  }
  end(0);
  end(1);
  if (found.isSameContent && a.lostFrame == b.lostFrame && a.failsafe == b.failsafe) {
    _counts.same++;
    return;
  }
  _counts.different++;
  if (_counts.first) {
    return;
  }
  _counts.first = Difference{us, "lost frame", 0, {a.lostFrame, b.lostFrame}};
  const auto end = a.raw.begin() + commonChannels(a, b);
  const auto at = std::mismatch(a.raw.begin(), end, b.raw.begin()).first;
  if (at != end) {
    const auto raw = static_cast<size_t>(at - a.raw.begin());
    _counts.first = Difference{us, "CH" + std::to_string(raw + 1), 0, {a.raw[raw], b.raw[raw]}};
  } else if (haveSwitches(a, b) && a.switches != b.switches) {
    const size_t i = a.switches[0] != b.switches[0] ? 0 : 1;
    constexpr const char *Names[][2] = {{"CH17", "CH18"}, {"DG1", "DG2"}};  // of 32 channels, CH17 is one
    const bool is32 = std::max(a.count, b.count) == 2 * sbus::ProportionalCount;
    _counts.first = Difference{us, Names[is32][i], 0, {a.switches[i], b.switches[i]}};
  } else if (a.failsafe != b.failsafe) {
    _counts.first = Difference{us, "failsafe", 0, {a.failsafe, b.failsafe}};
  }
}

// Delays of frames that were read on time replace those of late ones.
void Comparison::putDelay(int64_t us, const Alignment &found) {
  if (_counts.areDelaysLate && !found.isLate) {
    _counts.areDelaysLate = false;
    _counts.delays = Delays();
  }
  if (found.isLate == _counts.areDelaysLate) {
    _counts.delays.put(us, found.delayUs);
  }
}

void Comparison::lose(size_t side, int64_t us, bool isMissing) {
  end(1 - side);
  if (!_open[side]) {
    _open[side] = Span{{side, us, us, 0}, true};
  }
  Span &open = *_open[side];
  open.span.toUs = us;
  open.span.frames++;
  open.isMissing = open.isMissing && isMissing;
  if (open.isMissing) {
    _lines[side].without.push_back(us);
  }
}

// Before the first pair and after the last one, a line has lost the other's frames from its first character to its
// last; the others do not count. A frame in which it begins is not lost.
void Comparison::loseKnown(size_t side) {
  constexpr int64_t FrameUs = 5000;
  Line &line = _lines[side];
  const int64_t delayUs = side == 0 ? 0 : _aligner.delayUs();
  _open[side].reset();
  for (const int64_t us : std::exchange(line.without, {})) {
    if (line.toUs > line.fromUs && us - FrameUs >= line.fromUs - delayUs && us <= line.toUs - delayUs) {
      lose(side, us, true);
    } else {
      _counts.alone[1 - side]++;
    }
  }
}

void Comparison::end(size_t side) {
  _lines[side].without.clear();
  if (!_open[side]) {
    return;
  }
  const LostSpan span = _open[side]->span;
  _open[side].reset();
  if (!_counts.first) {
    _counts.first = Difference{span.fromUs, "", 1 - side, {}};
  }
  _counts.lost[span.side] += span.frames;
  _counts.spans[span.side]++;
  std::vector<LostSpan> &longest = _counts.longest[span.side];
  longest.push_back(span);
  std::stable_sort(longest.begin(), longest.end(),
                   [](const LostSpan &a, const LostSpan &b) { return a.frames > b.frames; });
  longest.resize(std::min(longest.size(), LongestMost));
  _tell(span);
}

std::string Comparison::rates() const {
  constexpr unsigned long Least = 100;  // frames
  const double a = _aligner.perSecond(0), b = _aligner.perSecond(1);
  return std::min(_counts.frames[0], _counts.frames[1]) < Least || std::max(a, b) < 1.2 * std::min(a, b)
             ? ""
             : format("A sends every %.2f ms, B every %.2f ms: frames differ while sticks move.", 1000 / a, 1000 / b);
}

std::string Comparison::why() const {
  const std::string one = rates(), other = scales();
  return one + (one.empty() || other.empty() ? "" : " ") + other;
}

std::string Comparison::scales() const {
  constexpr int Moved = 200, Differ = 8;  // of 2048
  const auto &[a, b] = _lines;
  const bool areAlike = _counts.same * 2 >= std::min(_counts.frames[0], _counts.frames[1]);
  for (size_t i = 0; !areAlike && i < std::min(a.channels, b.channels); i++) {
    const int low[] = {a.least[i], b.least[i]}, high[] = {a.most[i], b.most[i]};
    if (high[0] - low[0] >= Moved && high[1] - low[1] >= Moved &&
        std::max(std::abs(low[0] - low[1]), std::abs(high[0] - high[1])) > Differ) {
      return format("CH%zu goes from %d to %d in A, from %d to %d in B: their scales differ.", i + 1, low[0], high[0],
                    low[1], high[1]);
    }
  }
  return "";
}

void Comparison::finish() {
  _aligner.finish();
  for (const size_t side : {size_t{0}, size_t{1}}) {
    if (!_anyPair || (_open[side] && _open[side]->isMissing)) {
      loseKnown(side);
    }
    end(side);
  }
}

}  // namespace line
