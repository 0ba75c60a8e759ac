// sbus compare: compares two receivers, or the wire and a port: lost frames, delay, first difference.

#include <algorithm>
#include <array>
#include <memory>
#include <stdexcept>
#include <string>

#include "cli/Json.h"
#include "cli/Output.h"
#include "cli/SilenceNote.h"
#include "cli/options/SourceOption.h"
#include "cli/subcommands/Subcommands.h"
#include "line/Format.h"
#include "line/compare/Compared.h"
#include "line/compare/Comparison.h"

namespace tool {

namespace {

using line::Comparison;
using line::LostSpan;
using line::seconds;

const char *const Names[] = {"A", "B"};

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

// `zeroUs`: A's own time at the comparison's time 0.
std::string json(const LostSpan &span, int64_t zeroUs) {
  return Json("loss")
      .text("by", Names[span.side])
      .decimal("from_us", static_cast<double>(span.fromUs + zeroUs))
      .decimal("to_us", static_cast<double>(span.toUs + zeroUs))
      .number("frames", uint64_t{span.frames})
      .line();
}

std::string text(const line::Comparison &comparison, const std::array<std::string, 2> &names, int64_t zeroUs) {
  const Comparison::Counts &counts = comparison.counts();
  std::string text;
  for (const size_t side : {size_t{0}, size_t{1}}) {
    text += std::string(Names[side]) + "            " + names[side] + ": " + counted(counts.frames[side], "frame") +
            (counts.alone[side] > 0 ? line::format(", %lu before the beginning or after the end of %s",
                                                   counts.alone[side], Names[1 - side])
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
    text += line::format("not compared %lu of A, %lu of B: the PC was late\n", counts.late[0], counts.late[1]);
  }
  text += "first        " + differenceText(counts.first, zeroUs) + '\n';
  for (const auto &[name, why] : {std::pair("rates", comparison.rates()), std::pair("scales", comparison.scales())}) {
    text += why.empty() ? "" : line::format("%-12s ", name) + why + '\n';
  }
  return text + line::format("delay        of B: median %lld us, %lld to %lld us, drift %.1f us/s, found by %s%s\n",
                             static_cast<long long>(counts.delays.medianUs()),
                             static_cast<long long>(counts.delays.leastUs()),
                             static_cast<long long>(counts.delays.mostUs()), counts.delays.driftPpm(),
                             comparison.aligner().evidence().c_str(),
                             counts.areDelaysLate ? "; inaccurate, since the PC was late" : "");
}

std::string json(const line::Comparison &comparison, int64_t zeroUs) {
  const line::Aligner &aligner = comparison.aligner();
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
      .flag("late_delay", counts.areDelaysLate)
      .text("rates", comparison.rates())
      .text("scales", comparison.scales());
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

struct Options {
  explicit Options(Subcommand &subcommand) : a(subcommand, Playback::AtOnce, Rows::Rejected, "A") {}

  SourceOption a;
  std::string b;
  Option signalOption;
  std::string signal;  // of b
  bool json = false;
};

class Compared {
 public:
  Compared(const SourceOption &source, size_t side, Comparison &comparison)
      : _input(source.open()),
        _silence(source.name(), "frames", source.isFile()),
        _line(side, _input->settings().characterUs(), comparison) {
    if (!source.hasTimes()) {
      throw std::runtime_error(source.name() + ": has no times; a port, a recording or a capture is expected");
    }
    _input->endOnFailure();
  }

  // See line::Compared.
  void begin(int64_t laterUs) { _line.begin(laterUs); }

  Input &input() { return *_input; }
  Input::Taker taker() {
    return {[this](const line::Character &character) { _line.put(character); },
            [this](uint64_t nowUs) {
              _line.observer().idleUntil(_input->knownUs());
              // An unplugged port reports no times: assume that it has been silent for all but the last second.
              _line.knownUntil(std::max(_input->knownUs(), nowUs - std::min(nowUs, LateMostUs)), _input->hasEnded());
              _silence.tick(nowUs, _line.observer().counters().frames > 0);
            }};
  }

  void finish() {
    _line.observer().finish();
    _silence.end(_line.observer().counters().frames > 0);
  }

 private:
  static constexpr uint64_t LateMostUs = 1000000;

  const std::unique_ptr<Input> _input;
  SilenceNote _silence;
  line::Compared _line;
};

// Returns how much later the characters' time 0 is in `b` than in `a`, if both files give their start or none does.
int64_t laterUs(const SourceOption &a, const SourceOption &b) {
  return b.zeroUs() - a.zeroUs() +
         (a.isFile() && b.isFile() && a.startUs() && b.startUs() ? *b.startUs() - *a.startUs() : 0);
}

void run(const Options &options) {
  const SourceOption &a = options.a;
  const SourceOption b(a, options.b, options.signalOption, options.signal);
  line::Comparison comparison([&options](const line::LostSpan &span) {
    if (options.json) {
      write(json(span, options.a.zeroUs()));
      flush();
    }
  });
  Compared one(a, 0, comparison);
  Compared other(b, 1, comparison);
  one.begin(0);
  other.begin(laterUs(a, b));
  if (options.json) {
    write(a.json().line() + b.json().line());
    flush();
  }
  Input::runBoth(one.input(), one.taker(), other.input(), other.taker(), -laterUs(a, b));
  one.finish();
  other.finish();
  comparison.finish();
  if (!comparison.any()) {
    const std::string why = comparison.why();
    throw std::runtime_error(a.name() + " and " + b.name() + " have no frame in common" + (why.empty() ? "" : ". ") +
                             why);
  }
  write(options.json ? json(comparison, a.zeroUs()) : text(comparison, {a.name(), b.name()}, a.zeroUs()));
  flush();
  one.input().requireWhole();
  other.input().requireWhole();
}

}  // namespace

void addCompare(CLI::App &app) {
  Subcommand subcommand(app, "compare",
                        "compares two receivers, or wire and port: losses, delay, the first difference");
  const auto options = std::make_shared<Options>(subcommand);
  subcommand.option("B", options->b, "the other source").required().notEmpty().type("");
  options->signalOption = subcommand.option("--signal-b", options->signal, "the signal of B, if --signal is that of A")
                              .notEmpty()
                              .type("NAME");
  subcommand.flag("--json", options->json,
                  "JSON lines: each loss as it ends, then the first difference and the comparison");
  subcommand.footer(
      "It prints when both have ended, after --seconds, or after Ctrl-C. Times are those of A. A source has lost a "
      "frame if only the other one has it, or if only this one has the lost-frame or failsafe flag. Frames that came "
      "while the PC was late, or before the delay was known, are not compared.");
  subcommand.run([options] { run(*options); });
}

}  // namespace tool
