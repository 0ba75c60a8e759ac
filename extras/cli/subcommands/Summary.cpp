// sbus summary: a flight in a few lines: when failsafe and losses were and for how long, and how often frames came.

#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "cli/FlagSpans.h"
#include "cli/Format.h"
#include "cli/Json.h"
#include "cli/Output.h"
#include "cli/SilenceNote.h"
#include "cli/VariantOfLine.h"
#include "cli/options/SourceOption.h"
#include "cli/subcommands/Subcommands.h"
#include "line/Observer.h"

namespace tool {

namespace {

constexpr size_t ShownMost = 20;       // spans of a kind
constexpr unsigned long BarMost = 50;  // characters

double seconds(uint64_t us) {
  return static_cast<double>(us) / 1e6;
}

// What is listed: `name` in the text, `type` in JSON.
struct Listed {
  FlagSpan::Kind kind;
  const char *name;
  const char *type;
};
constexpr Listed AllListed[] = {{FlagSpan::Kind::Failsafe, "failsafe", "failsafe"},
                                {FlagSpan::Kind::LostFrame, "lost frames", "lost_frames"},
                                {FlagSpan::Kind::NoFrames, "no frames", "no_frames"},
                                {FlagSpan::Kind::Late, "PC late", "late"}};

std::string text(const char *name, const std::vector<FlagSpan> &spans) {
  if (spans.empty()) {
    return format("%-12s none\n", name);
  }
  uint64_t us = 0;
  for (const FlagSpan &span : spans) {
    us += span.us();
  }
  std::vector<FlagSpan> shown = spans;
  std::stable_sort(shown.begin(), shown.end(), [](const FlagSpan &a, const FlagSpan &b) { return a.us() > b.us(); });
  shown.resize(std::min(shown.size(), ShownMost));
  std::sort(shown.begin(), shown.end(), [](const FlagSpan &a, const FlagSpan &b) { return a.fromUs < b.fromUs; });
  std::string text = format("%-12s %zu %s, %.3f s in all%s\n", name, spans.size(), spans.size() == 1 ? "time" : "times",
                            seconds(us), shown.size() < spans.size() ? "; the longest are" : "");
  for (const FlagSpan &span : shown) {
    text += format("%14.3f s to %10.3f s %10.3f s\n", seconds(span.fromUs), seconds(span.toUs), seconds(span.us()));
  }
  return text;
}

std::string json(const char *type, const std::vector<FlagSpan> &spans) {
  std::string lines;
  for (const FlagSpan &span : spans) {
    lines += Json("span").text("kind", type).number("from_us", span.fromUs).number("to_us", span.toUs).line();
  }
  return lines;
}

class Summary {
 public:
  explicit Summary(uint32_t characterUs) {
    _observer.reset(0, characterUs);
    _observer.listen([this](const line::Stretch &stretch) { take(stretch); });
  }
  Summary(const Summary &) = delete;  // its observer's listener points to it
  Summary &operator=(const Summary &) = delete;

  line::Observer &observer() { return _observer; }
  void finish() {
    _observer.finish();
    _flags.finish();
  }
  bool any() const { return _observer.counters().frames > 0; }

  std::string text(const std::string &name, bool hasTimes) const {
    const sbus::Counters &counters = _observer.counters();
    const std::string counts =
        name + ": " + _variant.text() + ", " +
        format("%lu frames, %lu with the lost-frame flag, %lu in failsafe; %lu discarded bytes, %lu character errors\n",
               static_cast<unsigned long>(counters.frames), static_cast<unsigned long>(counters.lostFrames),
               static_cast<unsigned long>(counters.failsafeFrames), _observer.discardedBytes(),
               _observer.characterErrors());
    return counts + (hasTimes ? times() : "frames       -, times are not known\n");
  }

  std::string json(bool hasTimes) const {
    const sbus::Counters &counters = _observer.counters();
    Json summary("summary");
    summary.text("line", _variant.text());
    const auto known = [hasTimes](uint64_t us) { return hasTimes ? std::optional<uint64_t>(us) : std::nullopt; };
    summary.number("from_us", known(_flags.firstUs())).number("to_us", known(_flags.lastUs()));
    summary.counts(counters)
        .number("discarded_bytes", _observer.discardedBytes())
        .number("character_errors", _observer.characterErrors());
    std::string lines = summary.line();
    if (hasTimes) {
      for (const Listed &each : AllListed) {
        lines += tool::json(each.type, spans(each.kind));
      }
      for (const auto &[ms, count] : _intervals) {
        lines += Json("interval").number("ms", ms).number("count", count).line();
      }
    }
    return lines;
  }

 private:
  void take(const line::Stretch &stretch) {
    _variant.take(stretch);
    if (!stretch.isFrame() || stretch.kind == line::Stretch::Kind::Extra) {
      return;
    }
    const uint64_t us = stretch.endUs();
    if (!_flags.brokenUntil(us, stretch.lateUs()) && _flags.lastUs() > 0) {
      _intervals[(us - _flags.lastUs() + 500) / 1000]++;
    }
    _flags.put(us, _observer.inFailsafe(), _observer.newest().lostFrame);
  }

  std::vector<FlagSpan> spans(FlagSpan::Kind kind) const {
    std::vector<FlagSpan> spans;
    std::copy_if(_flags.all().begin(), _flags.all().end(), std::back_inserter(spans),
                 [kind](const FlagSpan &span) { return span.kind == kind; });
    return spans;
  }

  std::string times() const {
    std::string text =
        format("%-12s %.3f s to %.3f s\n", "frames", seconds(_flags.firstUs()), seconds(_flags.lastUs()));
    for (const Listed &each : AllListed) {
      const std::vector<FlagSpan> all = spans(each.kind);
      text += all.empty() && each.kind == FlagSpan::Kind::Late ? "" : tool::text(each.name, all);
    }
    unsigned long most = 1;
    for (const auto &[ms, count] : _intervals) {
      most = std::max(most, count);
    }
    text += "intervals from the end of a frame to the end of the next, in ms\n";
    for (const auto &[ms, count] : _intervals) {
      text += format("%12llu %9lu  ", static_cast<unsigned long long>(ms), count) +
              std::string((count * BarMost + most - 1) / most, '#') + '\n';
    }
    return text;
  }

  line::Observer _observer;
  VariantOfLine _variant;
  FlagSpans _flags;
  std::map<uint64_t, unsigned long> _intervals;  // by ms, rounded
};

void run(const SourceOption &source, bool asJson) {
  const std::unique_ptr<Input> input = source.open();
  Summary summary(input->settings().characterUs());
  SilenceNote silence(source.name(), "frames");
  input->run([&summary](const line::Character &character) { summary.observer().put(character); },
             [&](uint64_t nowUs) {
               summary.observer().idleUntil(input->knownUs());
               silence.tick(nowUs, summary.any());
             });
  summary.finish();
  silence.end(summary.any());
  write(asJson ? source.json().line() + summary.json(source.hasTimes())
               : summary.text(source.name(), source.hasTimes()));
  if (!asJson && !input->note().empty()) {
    write(input->note() + '\n');
  }
  flush();
}

}  // namespace

void addSummary(CLI::App &app) {
  Subcommand subcommand(app, "summary", "a flight: when failsafe and losses were, how often frames came");
  const auto source = std::make_shared<SourceOption>(subcommand, Recordings::AtOnce);
  const auto json = std::make_shared<bool>(false);
  subcommand.flag("--json", *json, "JSON lines");
  subcommand.footer(
      "It is printed when the source ends, after --seconds, or after Ctrl-C. Failsafe and losses last from the first "
      "frame with the flag to the next one without; no frames: 0.1 s and more. PC late: a port was read 0.1 s late or "
      "more, so what the line did meanwhile is not known.");
  subcommand.run([source, json] { run(*source, *json); });
}

}  // namespace tool
