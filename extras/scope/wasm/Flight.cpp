// The report of a whole recording, as sbus summary -o writes it: for the page as JSON, and as a page of its own.
#include <algorithm>
#include <memory>

#include "ShownLine.h"
#include "Tape.h"
#include "line/Format.h"
#include "line/report/HtmlReport.h"

using namespace scope;

namespace {

using Kind = line::FlagSpan::Kind;

constexpr size_t PartMax = 50000;  // characters, which are decoded in 10 ms or so
constexpr size_t StripParts = 512;
constexpr size_t WorstMost = 10;
constexpr size_t SpansMost = 10;  // of a kind

std::unique_ptr<line::FlightLog> flight;
size_t taken;
std::string words;

unsigned long long number(uint64_t us) {
  return us;
}

std::string json(const std::vector<line::FlightRating> &parts) {
  std::string text;
  for (const line::FlightRating &part : parts) {
    text += line::format("%s[%llu,%llu,%.5f,%d]", text.empty() ? "" : ",", number(part.fromUs), number(part.toUs),
                         part.lost, static_cast<int>(part.kind()));
  }
  return "[" + text + "]";
}

std::string json(const std::vector<line::FlagSpan> &spans) {
  std::string text = line::format("{\"count\":%zu,\"us\":%llu,\"longest\":[", spans.size(), number(sumUs(spans)));
  const std::vector<line::FlagSpan> shown = longest(spans, SpansMost);
  for (const line::FlagSpan &span : shown) {
    text += line::format("%s[%llu,%llu]", &span == &shown[0] ? "" : ",", number(span.fromUs), number(span.toUs));
  }
  return text + "]}";
}

std::string json(const line::FlightLog &log) {
  const line::FlightVerdict verdict = verdictOf(log);
  const sbus::Counters counters = log.observer().counters();
  std::string text = line::format("{\"severity\":%d,\"text\":\"%s\",\"fromUs\":%llu,\"toUs\":%llu,",
                                  static_cast<int>(verdict.severity), verdict.text.c_str(), number(log.firstUs()),
                                  number(log.lastUs()));
  text += line::format(
      "\"frames\":%lu,\"lostFrames\":%lu,\"failsafeFrames\":%lu,\"missing\":%lu,\"framesPerSecond\":%.3f,"
      "\"discardedBytes\":%lu,\"characterErrors\":%lu,\"spans\":[",
      static_cast<unsigned long>(counters.frames), static_cast<unsigned long>(counters.lostFrames),
      static_cast<unsigned long>(counters.failsafeFrames), log.rate().missing(), log.rate().perSecond(),
      log.observer().discardedBytes(), log.observer().characterErrors());
  for (const Kind kind : {Kind::Failsafe, Kind::NoPulses, Kind::LostFrame, Kind::NoFrames, Kind::Late}) {
    text += (kind == Kind::Failsafe ? "" : ",") + json(log.spans(kind));
  }
  return text + "],\"worst\":" + json(worstSeconds(log, WorstMost)) + ",\"strip\":" + json(stripOf(log, StripParts)) +
         "}";
}

}  // namespace

// Takes the next part of the recording. Call it again until it returns 1.
EXPORT(flightPart)()->int {
  const line::Characters &characters = theTape.recording.characters;
  if (!flight) {
    flight = std::make_unique<line::FlightLog>(theTape.settings.characterUs());
  }
  for (const size_t end = std::min(taken + PartMax, characters.size()); taken < end; taken++) {
    flight->put(characters[taken]);
  }
  if (taken < characters.size()) {
    return 0;
  }
  flight->finish();
  return 1;
}

// After the last part. Returns "" of a recording without frames.
EXPORT(flightNumbers)()->const char * {
  words = flight->any() ? json(*flight) : "";
  return words.c_str();
}
EXPORT(flightPage)()->const char * {
  words = htmlReport(*flight, {theTape.name, text(theTape.settings), theTape.startUs});
  return words.c_str();
}
