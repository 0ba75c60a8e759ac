// sbus watch: a flight recorder; it keeps the seconds before and after each event.

#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>

#include "cli/Json.h"
#include "cli/Output.h"
#include "cli/SilenceNote.h"
#include "line/file/Units.h"
#include "cli/options/RangeOption.h"
#include "cli/options/SourceOption.h"
#include "cli/subcommands/Subcommands.h"
#include "cli/watch/FlightRecorder.h"
#include "line/Condition.h"
#include "line/Format.h"
#include "line/recording/WallTime.h"

namespace tool {

namespace {

struct Options {
  explicit Options(Subcommand &subcommand) : source(subcommand, Playback::AtOnce, Rows::Rejected), range(subcommand) {}

  SourceOption source;
  RangeOption range;
  std::string when;
  std::string folder;
  double beforeS = 2;
  double afterS = 5;
  double longestS = 600;
  double mostMb = 1000;
  bool json = false;
};

uint64_t toUs(double seconds) { return static_cast<uint64_t>(seconds * 1e6); }

const char *nameOf(RecordedEvent::Kind kind) {
  const char *const names[] = {"begin", "continued", "end"};
  return names[static_cast<int>(kind)];
}

std::string text(const RecordedEvent &event, int64_t zeroUs) {
  return line::format("%12.3f s %-9s ", line::seconds(static_cast<int64_t>(event.us) + zeroUs), nameOf(event.kind)) +
         event.file + (event.summary.empty() ? "" : ": " + event.summary) + '\n';
}

std::string json(const RecordedEvent &event, int64_t zeroUs, std::optional<int64_t> startUs) {
  const int64_t us = static_cast<int64_t>(event.us) + zeroUs;
  Json line("event");
  line.decimal("time_us", static_cast<double>(us)).text("kind", nameOf(event.kind));
  if (startUs) {
    line.text("date", line::wallTime(*startUs + us));
  }
  if (!event.file.empty()) {
    line.text("file", event.file);
  }
  return line.line();
}

line::Condition conditionOf(const Options &options) {
  line::Condition condition(options.when, [range = options.range.range()](unsigned, uint16_t raw, bool isPercent) {
    return isPercent ? std::round(10 * line::valueOf(raw, line::Unit::Percent, range)) / 10
                     : std::round(line::valueOf(raw, line::Unit::Us, range));
  });
  const line::Condition::Error &error = condition.error();
  if (!error.text.empty()) {
    rejectCommandLine("--when: \"" + options.when + "\": at character " + std::to_string(error.at + 1) + " " +
                      error.text);
  }
  return condition;
}

void run(const Options &options) {
  const SourceOption &source = options.source;
  const line::Condition condition = conditionOf(options);
  const std::unique_ptr<Input> input = source.open();
  const EventFiles files(options.folder, static_cast<uint64_t>(options.mostMb * 1e6));
  if (options.json) {
    write(source.json().line());
    flush();
  }
  FlightRecorder recorder(
      {"watch " + source.name() + ": " + options.when, toUs(options.beforeS), toUs(options.afterS),
       toUs(options.longestS)},
      files, input->settings(), source.hasTimes(), source.startUs(), source.zeroUs(), [&](const RecordedEvent &event) {
        write(options.json ? json(event, source.zeroUs(), source.startUs()) : text(event, source.zeroUs()));
        flush();
      });
  line::Observer observer;
  observer.reset(0, input->settings().characterUs());
  bool isRejected = false;  // the newest stretch
  bool isOver = false;
  const auto tick = [&](uint64_t nowUs, uint64_t sinceUs) {
    recorder.tick(nowUs, condition.holds(line::Moment(observer, nowUs, isRejected)), sinceUs);
  };
  observer.listen([&](const line::Stretch &stretch) {
    isRejected = line::isRejected(stretch);
    recorder.put(stretch);
    if (!isOver) {
      tick(stretch.endUs(), stretch.characters.front().endUs);
    }
  });
  SilenceNote silence(source.name(), "frames", source.isFile());
  input->endOnFailure();
  input->run([&](const line::Character &character) { observer.put(character); },
             [&](uint64_t nowUs) {
               observer.idleUntil(input->knownUs());
               recorder.idleUntil(input->knownUs());
               if (!input->hasEnded()) {
                 tick(nowUs, UINT64_MAX);
               }
               silence.tick(nowUs, observer.counters().frames > 0);
             });
  isOver = true;
  observer.finish();
  recorder.finish();
  input->requireWhole();
  if (recorder.failures() > 0) {
    throw std::runtime_error(options.folder + ": " + std::to_string(recorder.failures()) +
                             " recordings are incomplete; the reasons are above");
  }
}

}  // namespace

void addWatch(CLI::App &app) {
  Subcommand subcommand(app, "watch", "records what happens before and after each event, like a flight recorder");
  const auto options = std::make_shared<Options>(subcommand);
  subcommand.option("--when", options->when, "the event, such as 'failsafe || ch5>1500'").required().type("CONDITION");
  subcommand.option("-o,--output", options->folder, "the folder for the recordings").required().notEmpty().type("FILE");
  subcommand.option("--before", options->beforeS, "seconds before an event (2)").between(0, 600).type("S");
  subcommand.option("--after", options->afterS, "seconds after an event (5)").between(0, 3600).type("S");
  subcommand
      .option("--longest", options->longestS,
              "the length of a file, in seconds; a longer event goes on in the next one (600)")
      .between(1, 86400)
      .type("S");
  subcommand.option("--most", options->mostMb, "keep at most MB megabytes, and delete the oldest (1000)")
      .between(0.001, 1e6)
      .type("MB");
  subcommand.flag("--json", options->json, "JSON lines: the events");
  subcommand.footer(
      "A condition compares (<, <=, >, >=, =, !=) ch1 to ch32 with 1500, 1500us or 50%, age with a time such as "
      "50ms, or quality with percent; or it names failsafe, nopulses, lostframe, rejected, jump, ok, lossy, stale, "
      "ch17 or ch18. Join "
      "with !, && and || (or not, and, or) and (). The files stay valid if the disk fills up or the program is "
      "killed.");
  subcommand.run([options] { run(*options); });
}

}  // namespace tool
