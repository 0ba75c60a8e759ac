// Compares two lines, A and B: who lost what, and the delay. As sbus compare. Of recordings A is the one that is
// played; of live lines both are other instances, which hand over their records.
#include <algorithm>
#include <cstring>
#include <memory>

#include "ShownLine.h"
#include "Tape.h"
#include "line/Format.h"
#include "line/compare/Compared.h"
#include "line/compare/Comparison.h"

using namespace scope;

namespace {

constexpr int64_t StepUs = 100000;
constexpr int64_t SilenceUs = 2000;     // between frames
constexpr int64_t LiveHeldUs = 250000;  // a frame may wait for what follows it, and a port may be read this late

struct Comparing {
  explicit Comparing(int64_t later) : laterUs(later) {}

  // Returns A's time of a line's time. `side`: 0 or 1.
  int64_t timeOf(unsigned side, double us) const { return static_cast<int64_t>(us) + (side == 1 ? laterUs : 0); }

  line::Comparison comparison{[](const line::LostSpan &) {}};
  const int64_t laterUs;
};

struct ComparingRecordings : Comparing {
  ComparingRecordings(const line::LineSettings &settings, int64_t later)
      : Comparing(later), b(1, settings.characterUs(), comparison) {
    a.begin(0);
    b.begin(later);
  }

  // Takes A up to this time, and what is known by then of both.
  void until(int64_t us) {
    const line::Characters &characters = theTape.recording.characters;
    while (taken < characters.size() && static_cast<int64_t>(characters[taken].endUs) <= us) {
      a.put(characters[taken++]);
    }
    know(a, us);
    know(b, us - laterUs);
  }

  static void know(line::Compared &side, int64_t us) {
    if (us > 0) {
      side.observer().idleUntil(static_cast<uint64_t>(us));
      side.knownUntil(static_cast<uint64_t>(us));
    }
  }

  line::Compared a{0, theTape.settings.characterUs(), comparison};
  line::Compared b;
  size_t taken = 0;    // characters of A
  int64_t lastUs = 0;  // of the newest character of B
  int64_t nextUs = 0;  // when A follows again
};

std::unique_ptr<ComparingRecordings> comparing;
std::unique_ptr<Comparing> live;
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

// Returns when time 0 of the recording was, in us since 1970; 0 if it does not say so.
EXPORT(recordingStartUs)()->double {
  return static_cast<double>(theTape.startUs.value_or(0));
}

// Begins a comparison. B's settings are in the buffer (recordingSettings()). Its time 0 is `laterUs` after A's.
EXPORT(compareWith)(double laterUs)->void {
  line::LineSettings settings;
  std::memcpy(static_cast<void *>(&settings), transfer, sizeof settings);
  comparing.reset();
  comparing = std::make_unique<ComparingRecordings>(settings, static_cast<int64_t>(laterUs));
}

// The next characters of B are in the buffer, `size` bytes of them (recordingPart()).
EXPORT(comparePart)(unsigned size)->void {
  for (size_t at = 0; at < size; at += sizeof(line::Character)) {
    line::Character character;
    std::memcpy(static_cast<void *>(&character), transfer + at, sizeof character);
    const int64_t us = static_cast<int64_t>(character.endUs) + comparing->laterUs;
    if (us >= comparing->lastUs + SilenceUs && us >= comparing->nextUs) {
      comparing->until(us - SilenceUs / 2);
      comparing->nextUs = us + StepUs;
    }
    comparing->lastUs = us;
    comparing->b.put(character);
  }
}

// After the last part.
EXPORT(comparison)()->const char * {
  const line::Characters &characters = theTape.recording.characters;
  for (; comparing->taken < characters.size(); comparing->taken++) {
    comparing->a.put(characters[comparing->taken]);
  }
  comparing->a.observer().finish();
  comparing->b.observer().finish();
  comparing->comparison.finish();
  words = json(*comparing, comparing->comparison.counts());
  comparing.reset();
  return words.c_str();
}

// Begins a comparison of live lines. B's time 0 is `laterUs` after A's.
EXPORT(compareLive)(double laterUs)->void {
  live = std::make_unique<Comparing>(static_cast<int64_t>(laterUs));
  live->comparison.knownUntil(0, live->timeOf(0, 0));
  live->comparison.knownUntil(1, live->timeOf(1, 0));
}

// The next records of a line, 0 or 1, are in the buffer, `size` bytes of them.
EXPORT(compareRecords)(unsigned side, unsigned size)->void {
  const auto *const records = reinterpret_cast<const Record *>(transfer);
  for (const Record *record = records; record != records + size / sizeof *record; record++) {
    if (record->kind <= static_cast<uint8_t>(Kind::Frame24)) {
      live->comparison.put(side, live->timeOf(side, record->endUs), valuesOf(*record),
                        static_cast<int64_t>(record->lateUs));
    }
  }
}

// No other record of that line comes up to this time of it.
EXPORT(comparedUntil)(unsigned side, double us)->void {
  live->comparison.knownUntil(side, live->timeOf(side, us) - LiveHeldUs);
}

// Returns what was found so far.
EXPORT(comparisonSoFar)()->const char * {
  words = json(*live, live->comparison.soFar());
  return words.c_str();
}
