// Compares two lines, A and B: who lost what, and the delay. As sbus compare. Other instances decode them, and hand over
// their records.
#include <memory>

#include "ShownLine.h"
#include "line/Format.h"
#include "line/compare/Comparison.h"

using namespace scope;

namespace {

constexpr int64_t HeldUs = 250000;  // a frame may wait for what follows it, and a port may be read this late

struct Comparing {
  explicit Comparing(int64_t later) : laterUs(later) {}

  // Returns A's time of a line's time. `side`: 0 or 1.
  int64_t timeOf(unsigned side, double us) const { return static_cast<int64_t>(us) + (side == 1 ? laterUs : 0); }

  line::Comparison comparison{[](const line::LostSpan &) {}};
  const int64_t laterUs;
};

std::unique_ptr<Comparing> comparing;
std::string words;

std::string pair(const char *name, const std::array<unsigned long, 2> &counts) {
  return line::format("\"%s\":[%lu,%lu],", name, counts[0], counts[1]);
}

std::string json(const std::vector<line::LostSpan> &spans) {
  std::string text;
  for (const line::LostSpan &span : spans) {
    text += line::format("%s[%lld,%lld,%lu]", text.empty() ? "" : ",", static_cast<long long>(span.fromUs),
                         static_cast<long long>(span.toUs), span.frames);
  }
  return "[" + text + "]";
}

std::string json(const Comparing &found, const line::Comparison::Counts &counts) {
  const line::Delays &delays = counts.delays;
  const line::Comparison &comparison = found.comparison;
  return "{" + pair("frames", counts.frames) + pair("alone", counts.alone) + pair("lost", counts.lost) +
         pair("spans", counts.spans) + pair("late", counts.late) + "\"longest\":[" + json(counts.longest[0]) + "," +
         json(counts.longest[1]) + "]," +
         line::format(
             "\"same\":%lu,\"different\":%lu,\"delays\":%lu,\"medianUs\":%lld,\"leastUs\":%lld,\"mostUs\":%lld,"
             "\"driftPpm\":%.3f,\"atZeroUs\":%.1f,\"laterUs\":%lld,\"evidence\":\"%s\","
             "\"ends\":\"%s\",\"areDelaysLate\":%s}",
             counts.same, counts.different, delays.count(), static_cast<long long>(delays.medianUs()),
             static_cast<long long>(delays.leastUs()), static_cast<long long>(delays.mostUs()), delays.driftPpm(),
             delays.at(0), static_cast<long long>(found.laterUs), comparison.aligner().evidence().c_str(), comparison.why().c_str(),
             counts.areDelaysLate ? "true" : "false");
}

line::Values valuesOf(const Record &record) {
  line::Values values;
  values.count = record.channelCount;
  for (size_t i = 0; i < record.channelCount; i++) {
    values.raw[i] = static_cast<uint16_t>(record.channels[i]);
  }
  values.switches = {(record.flags & sbus::FlagChannel17) != 0, (record.flags & sbus::FlagChannel18) != 0};
  values.lostFrame = (record.flags & sbus::FlagLostFrame) != 0;
  values.failsafe = (record.flags & sbus::FlagFailsafe) != 0 && (record.flags & FlagByLosses) == 0;
  return values;
}

}  // namespace

// Begins a comparison. B's time 0 is `laterUs` after A's.
EXPORT(compare)(double laterUs)->void {
  comparing = std::make_unique<Comparing>(static_cast<int64_t>(laterUs));
  comparing->comparison.knownUntil(0, comparing->timeOf(0, 0));
  comparing->comparison.knownUntil(1, comparing->timeOf(1, 0));
}

// The next records of a line, 0 or 1, are in the buffer, `size` bytes of them.
EXPORT(compareRecords)(unsigned side, unsigned size)->void {
  const auto *const records = reinterpret_cast<const Record *>(transfer);
  for (const Record *record = records; record != records + size / sizeof *record; record++) {
    if (record->kind <= static_cast<uint8_t>(Kind::Frame24)) {
      comparing->comparison.put(side, comparing->timeOf(side, record->endUs), valuesOf(*record),
                                static_cast<int64_t>(record->lateUs));
    }
  }
}

// No other record of that line comes up to this time of it.
EXPORT(comparedUntil)(unsigned side, double us)->void {
  comparing->comparison.knownUntil(side, comparing->timeOf(side, us) - HeldUs);
}

// Returns what was found so far; `atEnd`: of all.
EXPORT(comparison)(int atEnd)->const char * {
  if (atEnd != 0) {
    comparing->comparison.finish();
  }
  words = json(*comparing, atEnd != 0 ? comparing->comparison.counts() : comparing->comparison.soFar());
  return words.c_str();
}
