// The report of a whole recording, as sbus summary -o writes it: for the page as JSON, and as a page of its own.
#include <algorithm>
#include <memory>

#include "ShownLine.h"
#include "Tape.h"
#include "line/Format.h"
#include "line/report/HtmlReport.h"

using namespace scope;

namespace {

constexpr size_t StripParts = 512;
constexpr size_t WorstMost = 10;
constexpr size_t SpansMost = 10;  // of a kind

std::unique_ptr<line::FlightLog> growing;  // while the recording is decoded
std::unique_ptr<line::FlightLog> flight;   // once it is
std::string words;

unsigned long long number(uint64_t us) { return us; }

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
    text += line::format("%s[%llu,%llu,\"%s\"]", &span == &shown[0] ? "" : ",", number(span.fromUs), number(span.toUs),
                         jumpedText(span).c_str());
  }
  return text + "]}";
}

std::string json(const line::FlightLog &log) {
  const line::FlightVerdict verdict = verdictOf(log, theTape.hasTimes);
  const line::FlightCounts &counts = log.counts();
  std::string text = line::format("{\"severity\":%d,\"text\":\"%s\",\"fromUs\":%llu,\"toUs\":%llu,",
                                  static_cast<int>(verdict.severity), verdict.text.c_str(), number(log.firstUs()),
                                  number(log.lastUs()));
  text += line::format(
      "\"frames\":%lu,\"lostFrames\":%lu,\"failsafeFrames\":%lu,\"missing\":%lu,\"framesPerSecond\":%.3f,"
      "\"discardedBytes\":%lu,\"characterErrors\":%lu,\"spans\":[",
      counts.frames, counts.lostFrames, counts.failsafeFrames, log.rate().missing(), log.rate().perSecond(),
      counts.discardedBytes, counts.characterErrors);
  for (const line::SpanName &each : line::SpanNames) {
    text += (&each == line::SpanNames ? "" : ",") + json(log.spans(each.kind));
  }
  return text + "],\"worst\":" + json(worstSeconds(log, WorstMost)) + ",\"strip\":" + json(stripOf(log, StripParts)) +
         "}";
}

}  // namespace

// Before the first records.
EXPORT(beginFlight)()->void {
  growing = std::make_unique<line::FlightLog>();
  if (theTape.recording.endUs > 0) {
    growing->heard(theTape.recording.beginUs, true);
  }
}

// The recording's next records are in the buffer, `size` bytes of them.
EXPORT(flightRecords)(unsigned size)->void {
  const auto *const records = reinterpret_cast<const Record *>(transfer);
  for (const Record *record = records; record != records + size / sizeof *record; record++) {
    const auto endUs = static_cast<uint64_t>(record->endUs),
               bytesUs = uint64_t{theTape.settings.characterUs()} * record->size;
    if (record->kind <= static_cast<uint8_t>(scope::Kind::NoFrame)) {
      growing->heard(endUs - std::min(endUs, bytesUs));
      growing->heard(endUs);
    }
    if (record->kind <= static_cast<uint8_t>(scope::Kind::Extra)) {
      line::FlightFrame frame{static_cast<line::Stretch::Kind>(record->kind),
                              record->bytes[record->size - 1],
                              static_cast<uint64_t>(record->endUs),
                              static_cast<uint32_t>(record->lateUs),
                              (record->flags & sbus::FlagFailsafe) != 0,
                              (record->flags & sbus::FlagLostFrame) != 0,
                              (record->flags & FlagNoPulses) != 0,
                              {},
                              record->channelCount};
      std::transform(record->channels, record->channels + record->channelCount, frame.channels.begin(),
                     [](double raw) { return static_cast<uint16_t>(raw); });
      growing->put(frame);
    }
  }
}

// After the last records, with the counts of the decoder. Returns "" of a recording without frames.
EXPORT(flightNumbers)
(unsigned frames, unsigned lost, unsigned failsafe, unsigned discarded, unsigned errors)->const char * {
  if (theTape.recording.endUs > 0) {
    growing->heard(theTape.recording.endUs, true);
  }
  growing->finish({frames, lost, failsafe, discarded, errors});
  flight = std::move(growing);
  words = frames > 0 ? json(*flight) : "";
  return words.c_str();
}

EXPORT(flightPage)()->const char * {
  words = htmlReport(*flight, {theTape.name, text(theTape.settings), theTape.startUs});
  return words.c_str();
}
