// sbus compare: compares two receivers, or the wire and a port: lost frames, delay, first difference.

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "cli/Output.h"
#include "cli/SilenceNote.h"
#include "cli/compare/ComparisonReport.h"
#include "cli/options/SourceOption.h"
#include "cli/subcommands/Subcommands.h"
#include "line/compare/Compared.h"

namespace tool {

namespace {

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
  Compared(const SourceOption &source, size_t side, line::Aligner &aligner)
      : _input(source.open()),
        _silence(source.name(), "frames", source.isFile()),
        _line(side, _input->settings().characterUs(), aligner) {
    if (!source.hasTimes()) {
      throw std::runtime_error(source.name() + ": has no times; a port, a recording or a capture is expected");
    }
  }

  // See line::Compared.
  void begin(int64_t laterUs) { _line.begin(laterUs); }

  Input &input() { return *_input; }
  Input::Taker taker() {
    return {[this](const line::Character &character) { _line.put(character); },
            [this](uint64_t nowUs) {
              _line.observer().idleUntil(_input->knownUs());
              // An unplugged port reports no times: assume that it has been silent for all but the last second.
              _line.knownUntil(std::max(_input->knownUs(), nowUs - std::min(nowUs, LateMostUs)));
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
  line::Aligner aligner([&comparison](int64_t us, const line::Alignment &found) { comparison.put(us, found); });
  Compared one(a, 0, aligner);
  Compared other(b, 1, aligner);
  one.begin(0);
  other.begin(laterUs(a, b));
  if (options.json) {
    write(a.json().line() + b.json().line());
    flush();
  }
  Input::runBoth(one.input(), one.taker(), other.input(), other.taker(), -laterUs(a, b));
  one.finish();
  other.finish();
  aligner.finish();
  comparison.finish();
  if (!comparison.any()) {
    throw std::runtime_error(a.name() + " and " + b.name() + " have no frame in common");
  }
  write(options.json ? json(comparison, a.zeroUs(), aligner)
                     : text(comparison, {a.name(), b.name()}, a.zeroUs(), aligner));
  flush();
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
  subcommand.flag("--json", options->json, "JSON lines");
  subcommand.footer(
      "It prints when both have ended, after --seconds, or after Ctrl-C. Times are those of A. A source has lost a "
      "frame if only the other one has it, or if only this one has the lost-frame or failsafe flag. Frames that came "
      "while the PC was late, or before the delay was known, are not compared.");
  subcommand.run([options] { run(*options); });
}

}  // namespace tool
