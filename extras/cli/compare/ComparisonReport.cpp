#include "cli/compare/ComparisonReport.h"

#include <algorithm>

#include "cli/Json.h"
#include "line/Format.h"

namespace tool {

namespace {

constexpr size_t ShownMost = 20;
const char *const Names[] = {"A", "B"};

double seconds(int64_t us) {
  return static_cast<double>(us) / 1e6;
}

std::string counted(unsigned long count, const char *what) {
  return line::format("%lu %s%s", count, what, count == 1 ? "" : "s");
}

bool isFlagged(const line::Values &values) {
  return values.lostFrame || values.failsafe;
}

}  // namespace

std::string LostSpan::json() const {
  return Json("loss")
      .text("by", Names[side])
      .decimal("from_us", static_cast<double>(fromUs))
      .decimal("to_us", static_cast<double>(toUs))
      .number("frames", uint64_t{frames})
      .line();
}

void ComparisonReport::put(int64_t us, const Finding &finding) {
  if (finding.kind == Finding::Kind::Pair) {
    putPair(us, finding);
    return;
  }
  _frames[finding.side]++;
  if (!_anyPair) {
    _alone[finding.side]++;
    return;
  }
  lose(1 - finding.side, us, true);
}

void ComparisonReport::putPair(int64_t us, const Finding &finding) {
  const line::Values &a = *finding.values[0], &b = *finding.values[1];
  _anyPair = true;
  _frames[0]++;
  _frames[1]++;
  if (finding.isSameContent) {
    _delays.put(us, finding.delayUs);
  }
  if (isFlagged(a) != isFlagged(b)) {
    lose(isFlagged(a) ? 0 : 1, us, false);
    return;
  }
  end(0);
  end(1);
  if (finding.isSameContent && a.lostFrame == b.lostFrame && a.failsafe == b.failsafe) {
    _same++;
    return;
  }
  _different++;
  if (_first) {
    return;
  }
  _first = Difference{us, "lost frame", 0, {a.lostFrame, b.lostFrame}};
  const size_t raw =
      static_cast<size_t>(std::mismatch(a.raw.begin(), a.raw.end(), b.raw.begin()).first - a.raw.begin());
  if (raw < a.raw.size()) {
    _first = Difference{us, "CH" + std::to_string(raw + 1), 0, {a.raw[raw], b.raw[raw]}};
  } else if (a.switches != b.switches) {
    const size_t i = a.switches[0] != b.switches[0] ? 0 : 1;
    _first = Difference{us, "CH" + std::to_string(17 + i), 0, {a.switches[i], b.switches[i]}};
  } else if (a.failsafe != b.failsafe) {
    _first = Difference{us, "failsafe", 0, {a.failsafe, b.failsafe}};
  }
}

void ComparisonReport::lose(size_t side, int64_t us, bool isMissing) {
  end(1 - side);
  if (!_open[side]) {
    _open[side] = Span{{side, us, us, 0}, true};
  }
  Span &open = *_open[side];
  open.span.toUs = us;
  open.span.frames++;
  open.isMissing = open.isMissing && isMissing;
}

void ComparisonReport::end(size_t side) {
  if (!_open[side]) {
    return;
  }
  const LostSpan span = _open[side]->span;
  _open[side].reset();
  if (!_first) {
    _first = Difference{span.fromUs, "", 1 - side, {}};
  }
  _lost[side] += span.frames;
  _spans[side]++;
  std::vector<LostSpan> &longest = _longest[side];
  longest.push_back(span);
  std::stable_sort(longest.begin(), longest.end(),
                   [](const LostSpan &a, const LostSpan &b) { return a.frames > b.frames; });
  longest.resize(std::min(longest.size(), ShownMost));
  _tell(span);
}

// What one has after the other's last frame is not lost.
void ComparisonReport::finish() {
  for (const size_t side : {size_t{0}, size_t{1}}) {
    if (_open[side] && _open[side]->isMissing) {
      _alone[1 - side] += _open[side]->span.frames;
      _open[side].reset();
    }
    end(side);
  }
}

std::string ComparisonReport::differenceText() const {
  if (!_first) {
    return "none";
  }
  const std::string time = line::format("%.3f s: ", seconds(_first->us));
  return time + (_first->name.empty()
                     ? std::string("only ") + Names[_first->side] + " has the frame"
                     : _first->name + line::format(" is %u in A, %u in B", _first->values[0], _first->values[1]));
}

std::string ComparisonReport::lostText(size_t side) const {
  std::vector<LostSpan> shown = _longest[side];
  std::sort(shown.begin(), shown.end(), [](const LostSpan &a, const LostSpan &b) { return a.fromUs < b.fromUs; });
  std::string text =
      line::format("lost by %s    %s in %s%s\n", Names[side], counted(_lost[side], "frame").c_str(),
                   counted(_spans[side], "span").c_str(), _spans[side] > ShownMost ? "; the longest are" : "");
  for (const LostSpan &span : shown) {
    text += line::format("%14.3f s to %10.3f s   %s\n", seconds(span.fromUs), seconds(span.toUs),
                         counted(span.frames, "frame").c_str());
  }
  return text;
}

std::string ComparisonReport::text(const std::array<std::string, 2> &names, bool isByContents) const {
  std::string text;
  for (const size_t side : {size_t{0}, size_t{1}}) {
    text += std::string(Names[side]) + "            " + names[side] + ": " + counted(_frames[side], "frame") +
            (_alone[side] > 0
                 ? line::format(", %lu before the first or after the last of %s", _alone[side], Names[1 - side])
                 : "") +
            '\n';
  }
  text += "same         " + counted(_same, "frame") + "\ndifferent    " + counted(_different, "frame") + '\n' +
          lostText(0) + lostText(1);
  text += "first        " + differenceText() + '\n';
  return text + line::format("delay        of B: median %lld us, %lld to %lld us, drift %.1f us/s, found by %s\n",
                             static_cast<long long>(_delays.medianUs()), static_cast<long long>(_delays.leastUs()),
                             static_cast<long long>(_delays.mostUs()), _delays.driftPpm(),
                             isByContents ? "the contents" : "the times alone");
}

std::string ComparisonReport::json(bool isByContents) const {
  Json json("comparison");
  json.number("frames_a", uint64_t{_frames[0]}).number("frames_b", uint64_t{_frames[1]});
  json.number("alone_a", uint64_t{_alone[0]}).number("alone_b", uint64_t{_alone[1]});
  json.number("same", uint64_t{_same}).number("different", uint64_t{_different});
  json.number("lost_by_a", uint64_t{_lost[0]}).number("lost_by_b", uint64_t{_lost[1]});
  json.decimal("delay_us", static_cast<double>(_delays.medianUs()))
      .decimal("least_delay_us", static_cast<double>(_delays.leastUs()))
      .decimal("most_delay_us", static_cast<double>(_delays.mostUs()))
      .decimal("drift_ppm", _delays.driftPpm())
      .flag("by_contents", isByContents);
  if (!_first) {
    return json.line();
  }
  Json first("difference");
  first.decimal("time_us", static_cast<double>(_first->us));
  if (_first->name.empty()) {
    first.text("only", Names[_first->side]);
  } else {
    first.text("name", _first->name).number("a", uint64_t{_first->values[0]}).number("b", uint64_t{_first->values[1]});
  }
  return first.line() + json.line();
}

}  // namespace tool
