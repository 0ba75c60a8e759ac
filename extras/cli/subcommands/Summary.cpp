// sbus summary: summarises a flight in a few lines: failsafe and loss periods, frame intervals.

#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "cli/Json.h"
#include "cli/Output.h"
#include "cli/SilenceNote.h"
#include "cli/options/SourceOption.h"
#include "cli/subcommands/Subcommands.h"
#include "line/Examination.h"
#include "line/Format.h"
#include "line/report/HtmlReport.h"
#include "line/report/ObservedFlight.h"

namespace tool {

namespace {

constexpr size_t ShownMost = 20;       // spans of a kind
constexpr unsigned long BarMost = 50;  // characters

double seconds(uint64_t us, int64_t zeroUs = 0) { return line::seconds(static_cast<int64_t>(us) + zeroUs); }

std::string text(const char *name, const std::vector<line::FlagSpan> &spans, int64_t zeroUs) {
  if (spans.empty()) {
    return line::format("%-12s none\n", name);
  }
  std::vector<line::FlagSpan> shown = longest(spans, ShownMost);
  std::sort(shown.begin(), shown.end(),
            [](const line::FlagSpan &a, const line::FlagSpan &b) { return a.fromUs < b.fromUs; });
  std::string text =
      line::format("%-12s %zu %s, %.3f s in all%s\n", name, spans.size(), spans.size() == 1 ? "time" : "times",
                   seconds(sumUs(spans)), shown.size() < spans.size() ? "; the longest are" : "");
  for (const line::FlagSpan &span : shown) {
    const std::string what =
        span.channels != 0 ? "  " + jumpedText(span) : line::format("%10.3f s", seconds(span.us()));
    text += line::format("%14.3f s to %10.3f s %s\n", seconds(span.fromUs, zeroUs), seconds(span.toUs, zeroUs),
                         what.c_str());
  }
  return text;
}

std::string json(const char *type, const std::vector<line::FlagSpan> &spans, int64_t zeroUs) {
  std::string lines;
  for (const line::FlagSpan &span : spans) {
    Json line("span");
    line.text("kind", type)
        .digits("from_us", std::to_string(static_cast<int64_t>(span.fromUs) + zeroUs))
        .digits("to_us", std::to_string(static_cast<int64_t>(span.toUs) + zeroUs));
    if (const std::vector<unsigned> channels = jumped(span); !channels.empty()) {
      line.numbers("channels", {channels.begin(), channels.end()});
    }
    lines += line.line();
  }
  return lines;
}

std::string textOf(const line::FlightLog &flight, int64_t zeroUs) {
  std::string text = line::format("%-12s %.3f s to %.3f s\n", "frames", seconds(flight.firstUs(), zeroUs),
                                  seconds(flight.lastUs(), zeroUs));
  for (const line::SpanName &each : line::SpanNames) {
    const std::vector<line::FlagSpan> all = flight.spans(each.kind);
    const bool isRare = each.kind == line::FlagSpan::Kind::NoPulses || each.kind == line::FlagSpan::Kind::Late ||
                        each.kind == line::FlagSpan::Kind::Jump;
    text += all.empty() && isRare ? "" : tool::text(each.name, all, zeroUs);
  }
  unsigned long most = 1;
  for (const auto &[ms, each] : flight.rate().intervals()) {
    most = std::max(most, each.count);
  }
  text += "intervals from the end of a frame to the end of the next, in ms\n";
  for (const auto &[ms, each] : flight.rate().intervals()) {
    text += line::format("%12llu %9lu  ", static_cast<unsigned long long>(ms), each.count) +
            std::string((each.count * BarMost + most - 1) / most, '#') + '\n';
  }
  return text;
}

bool isOtherSender(sbus::Finding finding) {
  return (finding >= sbus::Finding::IBus && finding <= sbus::Finding::IdleLevel) ||
         finding == sbus::Finding::WrongPackets;
}

// Returns what `sbus doctor` finds, if nothing else in a summary tells it.
std::string findingText(sbus::Finding finding) {
  const bool isShown = finding == sbus::Finding::UnusedFlags || finding == sbus::Finding::Noise ||
                       finding == sbus::Finding::SevenBits || finding == sbus::Finding::LostInTurn ||
                       finding == sbus::Finding::LongPeriod || isOtherSender(finding);
  return isShown ? std::string(sbus::text(finding)) : "";
}

std::string findings(const std::vector<std::string> &all) {
  std::string text;
  for (const std::string &each : all) {
    text += each.empty() ? "" : "finding      " + each + '\n';
  }
  return text;
}

std::string text(const line::FlightLog &flight, const SourceOption &source, sbus::Finding finding) {
  const line::FlightCounts &counts = flight.counts();
  const std::string damage = source.isFile() ? source.file().damage : "";
  const std::string end = source.hasTimes() ? flight.endText() : "";
  const bool isOfEnd = finding == sbus::Finding::WrongPackets && !end.empty();
  return source.name() + ": " + flight.variant() + ", " +
         line::format(
             "%lu frames, %lu with the lost-frame flag, %lu in failsafe; %lu discarded bytes, %lu character errors\n",
             counts.frames, counts.lostFrames, counts.failsafeFrames, counts.discardedBytes, counts.characterErrors) +
         findings({!damage.empty() ? damage
                   : isOfEnd       ? ""
                                   : findingText(finding),
                   end}) +
         (source.hasTimes() ? textOf(flight, source.zeroUs()) : "frames       -, times are not known\n");
}

std::string json(const line::ObservedFlight &observed, const SourceOption &source) {
  const line::FlightLog &flight = observed.log();
  Json summary("summary");
  summary.text("line", flight.variant());
  const auto known = [&source](uint64_t us) {
    return source.hasTimes() ? std::to_string(static_cast<int64_t>(us) + source.zeroUs()) : "null";
  };
  summary.digits("from_us", known(flight.firstUs())).digits("to_us", known(flight.lastUs()));
  summary.counts(observed.observer().counters())
      .number("discarded_bytes", uint64_t{flight.counts().discardedBytes})
      .number("character_errors", uint64_t{flight.counts().characterErrors});
  std::string lines = summary.line();
  if (source.hasTimes()) {
    for (const line::SpanName &each : line::SpanNames) {
      lines += json(each.type, flight.spans(each.kind), source.zeroUs());
    }
    for (const auto &[ms, each] : flight.rate().intervals()) {
      lines += Json("interval").number("ms", ms).number("count", uint64_t{each.count}).line();
    }
  }
  return lines;
}

struct Options {
  bool json = false;
  Option html;
  std::string output;
};

std::string html(const line::FlightLog &flight, const SourceOption &source) {
  if (!source.hasTimes()) {
    throw std::runtime_error(source.name() + ": its times are not known, and a report needs them");
  }
  line::ReportFacts facts;
  facts.name = source.name() == "-" ? "standard input" : source.name().substr(source.name().rfind('/') + 1);
  facts.settings = line::text(source.settings());
  facts.startUs = source.startUs();
  return htmlReport(flight, facts);
}

void run(const SourceOption &source, const Options &options) {
  const std::unique_ptr<Input> input = source.open();
  line::ObservedFlight flight(input->settings().characterUs(), source.zeroUs());
  SilenceNote silence(source.name(), "frames", source.isFile());
  line::Examination examination;
  uint64_t lastUs = 0;
  if (source.isFile() && source.file().isCapture()) {
    flight.begin(source.file().recording.beginUs);
  }
  input->endOnFailure();  // frames before a wrong line are summarised all the same
  input->run(
      [&](const line::Character &character) {
        if (lastUs == 0) {
          examination.begin(flight.observer(), character.endUs);
        }
        lastUs = character.endUs;
        flight.put(character);
      },
      [&](uint64_t nowUs) {
        flight.idleUntil(input->knownUs(), input->hasEnded());
        silence.tick(nowUs, flight.any());
      });
  flight.finish();
  if (!flight.any()) {
    input->requireWhole();
  }
  sbus::Diagnosis diagnosis;
  diagnosis.add(examination.trial(flight.observer(), input->settings(), lastUs));
  const sbus::Finding finding = diagnosis.finding();
  if (!flight.any() && flight.observer().readAtBaud() != 0) {
    throw std::runtime_error(source.name() + ": no frames received. A port has read S.Bus at " +
                             std::to_string(flight.observer().readAtBaud()) + " baud; it has 100000, 8E2");
  }
  if (!flight.any() && isOtherSender(finding)) {
    throw std::runtime_error(source.name() + ": no frames received. " + std::string(sbus::text(finding)));
  }
  silence.end(flight.any());
  if (options.html.given()) {
    rejectSameFile(source.name(), options.output);
    const std::string page = html(flight.log(), source);
    writeTo(options.output, File::New, [&page](const Put &put) { put(page); });
  } else {
    write(options.json ? source.json().line() + json(flight, source) : text(flight.log(), source, finding));
    if (!options.json && !input->note().empty()) {
      write(input->note() + '\n');
    }
    flush();
  }
  input->requireWhole();
}

}  // namespace

void addSummary(CLI::App &app) {
  Subcommand subcommand(app, "summary", "summarises a flight: failsafe and loss periods, intervals between frames");
  const auto source = std::make_shared<SourceOption>(subcommand, Playback::AtOnce, Rows::Rejected);
  const auto options = std::make_shared<Options>();
  const Option json =
      subcommand.flag("--json", options->json, "JSON lines: a summary, then the spans and the intervals");
  options->html =
      subcommand
          .option("-o,--output", options->output, "write a one-page report to view or print; - is standard output")
          .excludes(json)
          .notEmpty()
          .type("FILE.html");
  subcommand.footer(
      "It prints when the source ends, after --seconds, or after Ctrl-C. Failsafe and losses last from the first "
      "frame with the flag to the next one without; no pulses: CH1 to CH4 are 0 without a flag; no frames: 0.1 s or "
      "more, "
      "from the first byte, or a capture's beginning, to the last. "
      "Jumps: a channel leaves its course for one frame, farther than a stick can. PC late: bytes came 0.1 s late or "
      "more, from a busy PC or a stalled adapter, so the line's state in that time is unknown.");
  subcommand.run([source, options] { run(*source, *options); });
}

}  // namespace tool
