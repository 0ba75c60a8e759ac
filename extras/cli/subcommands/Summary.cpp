// sbus summary: a flight in a few lines: when failsafe and losses were and for how long, and how often frames came.

#include <algorithm>
#include <map>
#include <memory>
#include <stdexcept>
#include <vector>

#include "cli/Format.h"
#include "cli/Json.h"
#include "cli/VariantOfLine.h"
#include "cli/Output.h"
#include "cli/SilenceNote.h"
#include "cli/options/SourceOption.h"
#include "cli/subcommands/Subcommands.h"
#include "line/Observer.h"
#include "sbus/Link.h"

namespace tool {

namespace {

constexpr uint64_t SilenceUs = sbus::Link::DefaultTimeout * 1000;  // longer ones are listed, and no intervals
constexpr size_t ShownMost = 20;                                   // spans of a kind
constexpr unsigned long BarMost = 50;                              // characters

double seconds(uint64_t us) {
  return static_cast<double>(us) / 1e6;
}

struct Span {
  uint64_t fromUs;
  uint64_t toUs;

  uint64_t us() const { return toUs - fromUs; }
};

// While something is so: from the first frame that says it to the first one that does not.
class Spans {
 public:
  // `name`: of the text. `kind`: of JSON.
  Spans(const char *name, const char *kind) : _name(name), _kind(kind) {}

  void at(uint64_t us, bool is) {
    if (is && !_is) {
      _spans.push_back({us, us});
    } else if (_is) {
      _spans.back().toUs = us;
    }
    _is = is;
  }

  void add(const Span &span) { _spans.push_back(span); }

  std::string text() const {
    if (_spans.empty()) {
      return format("%-12s none\n", _name);
    }
    uint64_t us = 0;
    for (const Span &span : _spans) {
      us += span.us();
    }
    std::vector<Span> shown = _spans;
    std::stable_sort(shown.begin(), shown.end(), [](const Span &a, const Span &b) { return a.us() > b.us(); });
    shown.resize(std::min(shown.size(), ShownMost));
    std::sort(shown.begin(), shown.end(), [](const Span &a, const Span &b) { return a.fromUs < b.fromUs; });
    std::string text =
        format("%-12s %zu %s, %.3f s in all%s\n", _name, _spans.size(), _spans.size() == 1 ? "time" : "times",
               seconds(us), shown.size() < _spans.size() ? "; the longest are" : "");
    for (const Span &span : shown) {
      text += format("%14.3f s to %10.3f s %10.3f s\n", seconds(span.fromUs), seconds(span.toUs), seconds(span.us()));
    }
    return text;
  }

  std::string json() const {
    std::string lines;
    for (const Span &span : _spans) {
      lines += Json("span").text("kind", _kind).number("from_us", span.fromUs).number("to_us", span.toUs).line();
    }
    return lines;
  }

 private:
  const char *_name;
  const char *_kind;
  bool _is = false;
  std::vector<Span> _spans;
};

class Summary {
 public:
  explicit Summary(uint32_t characterUs) {
    _observer.reset(0, characterUs);
    _observer.listen([this](const line::Stretch &stretch) { take(stretch); });
  }
  Summary(const Summary &) = delete;  // its observer's listener leads into it
  Summary &operator=(const Summary &) = delete;

  line::Observer &observer() { return _observer; }
  bool any() const { return _observer.counters().frames > 0; }

  std::string text(const std::string &name, bool hasTimes) const {
    const sbus::Counters &counters = _observer.counters();
    const std::string counts =
        name + ": " + _kind.text() + ", " +
        format("%lu frames, %lu with the lost-frame flag, %lu in failsafe; %lu bytes of no frame, %lu bad characters\n",
               static_cast<unsigned long>(counters.frames), static_cast<unsigned long>(counters.lostFrames),
               static_cast<unsigned long>(counters.failsafeFrames), static_cast<unsigned long>(counters.discardedBytes),
               _observer.badCharacters());
    return counts + (hasTimes ? times() : "");
  }

  std::string json(bool hasTimes) const {
    const sbus::Counters &counters = _observer.counters();
    Json summary("summary");
    summary.text("line", _kind.text());
    if (hasTimes) {
      summary.number("from_us", _firstUs).number("to_us", _lastUs);
    }
    summary.number("frames", counters.frames)
        .number("lost_frames", counters.lostFrames)
        .number("failsafe_frames", counters.failsafeFrames)
        .number("discarded_bytes", counters.discardedBytes)
        .number("bad_characters", _observer.badCharacters());
    std::string lines = summary.line();
    if (hasTimes) {
      lines += _failsafe.json() + _lost.json() + _silent.json();
      for (const auto &[ms, count] : _intervals) {
        lines += Json("interval").number("ms", ms).number("count", count).line();
      }
    }
    return lines;
  }

 private:
  void take(const line::Stretch &stretch) {
    _kind.take(stretch);
    if (!stretch.isFrame() || stretch.kind == line::Stretch::Kind::Extra) {
      return;
    }
    const line::Values &values = _observer.newest();
    const uint64_t us = stretch.endUs();
    if (_lastUs > 0 && us - _lastUs > SilenceUs) {
      _failsafe.at(_lastUs, false);  // nothing is known of the silence
      _lost.at(_lastUs, false);
      _silent.add({_lastUs, us});
    } else if (_lastUs > 0) {
      _intervals[(us - _lastUs + 500) / 1000]++;
    }
    _failsafe.at(us, values.failsafe);
    _lost.at(us, values.lostFrame && !values.failsafe);
    _firstUs = _lastUs == 0 ? us : _firstUs;
    _lastUs = us;
  }

  std::string times() const {
    std::string text = format("%-12s %.3f s to %.3f s\n", "frames", seconds(_firstUs), seconds(_lastUs)) +
                       _failsafe.text() + _lost.text() + _silent.text();
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
  VariantOfLine _kind;
  uint64_t _firstUs = 0;  // of the frames
  uint64_t _lastUs = 0;   // 0: none yet
  Spans _failsafe{"failsafe", "failsafe"};
  Spans _lost{"lost frames", "lost_frames"};
  Spans _silent{"no frames", "no_frames"};
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
  summary.observer().finish();
  if (!summary.any()) {
    throw std::runtime_error(source.name() + ": no frames came; sbus doctor says why");
  }
  write(asJson ? summary.json(source.hasTimes()) : summary.text(source.name(), source.hasTimes()));
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
      "frame with the flag to the next one without; no frames: 0.1 s and more.");
  subcommand.run([source, json] { run(*source, *json); });
}

}  // namespace tool
