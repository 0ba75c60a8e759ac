#include "cli/compare/ComparisonReport.h"

#include <algorithm>

#include "cli/Json.h"
#include "line/Format.h"

namespace tool {

namespace {

using line::Comparison;
using line::LostSpan;

const char *const Names[] = {"A", "B"};

double seconds(int64_t us) {
  return static_cast<double>(us) / 1e6;
}

std::string counted(unsigned long count, const char *what) {
  return line::format("%lu %s%s", count, what, count == 1 ? "" : "s");
}

std::string differenceText(const std::optional<Comparison::Difference> &first, int64_t zeroUs) {
  if (!first) {
    return "none";
  }
  const std::string time = line::format("%.3f s: ", seconds(first->us + zeroUs));
  return time + (first->name.empty()
                     ? std::string("only ") + Names[first->side] + " has the frame"
                     : first->name + line::format(" is %u in A, %u in B", first->values[0], first->values[1]));
}

std::string lostText(const Comparison::Counts &counts, size_t side, int64_t zeroUs) {
  std::vector<LostSpan> shown = counts.longest[side];
  std::sort(shown.begin(), shown.end(), [](const LostSpan &a, const LostSpan &b) { return a.fromUs < b.fromUs; });
  std::string text =
      line::format("lost by %s    %s in %s%s\n", Names[side], counted(counts.lost[side], "frame").c_str(),
                   counted(counts.spans[side], "span").c_str(),
                   counts.spans[side] > Comparison::LongestMost ? "; the longest are" : "");
  for (const LostSpan &span : shown) {
    text += line::format("%14.3f s to %10.3f s   %s\n", seconds(span.fromUs + zeroUs), seconds(span.toUs + zeroUs),
                         counted(span.frames, "frame").c_str());
  }
  return text;
}

}  // namespace

std::string json(const LostSpan &span, int64_t zeroUs) {
  return Json("loss")
      .text("by", Names[span.side])
      .decimal("from_us", static_cast<double>(span.fromUs + zeroUs))
      .decimal("to_us", static_cast<double>(span.toUs + zeroUs))
      .number("frames", uint64_t{span.frames})
      .line();
}

std::string text(const line::Comparison &comparison, const std::array<std::string, 2> &names, int64_t zeroUs,
                 const line::Aligner &aligner) {
  const Comparison::Counts &counts = comparison.counts();
  std::string text;
  for (const size_t side : {size_t{0}, size_t{1}}) {
    text += std::string(Names[side]) + "            " + names[side] + ": " + counted(counts.frames[side], "frame") +
            (counts.alone[side] > 0
                 ? line::format(", %lu before the first or after the last of %s", counts.alone[side], Names[1 - side])
                 : "") +
            '\n';
  }
  const auto [a, b] = counts.channels;
  if (a != b) {
    text += line::format("channels     %u in A, %u in B: CH1 to CH%u are compared\n", a, b, std::min(a, b));
  }
  text += "same         " + counted(counts.same, "frame") + "\ndifferent    " + counted(counts.different, "frame") +
          '\n' + lostText(counts, 0, zeroUs) + lostText(counts, 1, zeroUs);
  if (counts.late[0] + counts.late[1] > 0) {
    text += line::format("not compared %lu of A, %lu of B: the PC was late, or the delay not known yet\n",
                         counts.late[0], counts.late[1]);
  }
  text += "first        " + differenceText(counts.first, zeroUs) + '\n';
  return text + line::format("delay        of B: median %lld us, %lld to %lld us, drift %.1f us/s, found by %s%s\n",
                             static_cast<long long>(counts.delays.medianUs()),
                             static_cast<long long>(counts.delays.leastUs()),
                             static_cast<long long>(counts.delays.mostUs()), counts.delays.driftPpm(),
                             aligner.evidence().c_str(),
                             counts.areDelaysLate ? "; inaccurate, since the PC was late" : "");
}

std::string json(const line::Comparison &comparison, int64_t zeroUs, const line::Aligner &aligner) {
  const Comparison::Counts &counts = comparison.counts();
  Json json("comparison");
  json.number("frames_a", uint64_t{counts.frames[0]}).number("frames_b", uint64_t{counts.frames[1]});
  json.number("alone_a", uint64_t{counts.alone[0]}).number("alone_b", uint64_t{counts.alone[1]});
  json.number("same", uint64_t{counts.same}).number("different", uint64_t{counts.different});
  json.number("lost_by_a", uint64_t{counts.lost[0]}).number("lost_by_b", uint64_t{counts.lost[1]});
  json.number("late_a", uint64_t{counts.late[0]}).number("late_b", uint64_t{counts.late[1]});
  json.decimal("delay_us", static_cast<double>(counts.delays.medianUs()))
      .decimal("least_delay_us", static_cast<double>(counts.delays.leastUs()))
      .decimal("most_delay_us", static_cast<double>(counts.delays.mostUs()))
      .decimal("drift_ppm", counts.delays.driftPpm())
      .flag("by_contents", aligner.by() == line::DelayBy::Contents)
      .flag("certain", aligner.isCertain())
      .text("evidence", aligner.evidence())
      .flag("late_delay", counts.areDelaysLate);
  if (!counts.first) {
    return json.line();
  }
  Json difference("difference");
  difference.decimal("time_us", static_cast<double>(counts.first->us + zeroUs));
  if (counts.first->name.empty()) {
    difference.text("only", Names[counts.first->side]);
  } else {
    difference.text("name", counts.first->name)
        .number("a", uint64_t{counts.first->values[0]})
        .number("b", uint64_t{counts.first->values[1]});
  }
  return difference.line() + json.line();
}

}  // namespace tool
