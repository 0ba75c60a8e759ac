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
  explicit Comparing(int64_t later) : laterUs(later) {
    least[0].fill(UINT16_MAX);
    least[1] = least[0];
  }

  // Returns A's time of a line's time. `side`: 0 or 1.
  int64_t timeOf(unsigned side, double us) const { return static_cast<int64_t>(us) + (side == 1 ? laterUs : 0); }

  void put(int64_t us, const line::Alignment &found) {
    comparison.put(us, found);
    for (size_t side = 0; side < 2; side++) {
      if (const std::optional<line::Values> &values = found.values[side]; values && !values->failsafe) {
        channels[side] = values->count;
        for (size_t i = 0; i < values->count; i++) {
          least[side][i] = std::min(least[side][i], values->raw[i]);
          most[side][i] = std::max(most[side][i], values->raw[i]);
        }
      }
    }
  }

  // Returns the first channel whose ends differ, if hardly any frames are alike: receivers scale sticks differently.
  std::string ends(const line::Comparison::Counts &counts) const {
    constexpr int Moved = 200, Differ = 8;  // of 2048
    const size_t common = counts.same * 2 < std::min(counts.frames[0], counts.frames[1]) ? std::min(channels[0], channels[1]) : 0;
    for (size_t i = 0; i < common; i++) {
      const int low[] = {least[0][i], least[1][i]}, high[] = {most[0][i], most[1][i]};
      if (high[0] - low[0] >= Moved && high[1] - low[1] >= Moved &&
          std::max(std::abs(low[0] - low[1]), std::abs(high[0] - high[1])) > Differ) {
        return line::format("CH%zu goes from %d to %d in A, from %d to %d in B: their scales differ.", i + 1, low[0], high[0], low[1], high[1]);
      }
    }
    return "";
  }

  line::Comparison comparison{[](const line::LostSpan &) {}};
  line::Aligner aligner{[this](int64_t us, const line::Alignment &found) { put(us, found); }};
  std::array<decltype(line::Values::raw), 2> least, most{};  // by side and channel, without failsafe
  std::array<size_t, 2> channels{};
  const int64_t laterUs;
};

struct ComparingRecordings : Comparing {
  ComparingRecordings(const line::LineSettings &settings, int64_t later)
      : Comparing(later), b(1, settings.characterUs(), aligner) {
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

  line::Compared a{0, theTape.settings.characterUs(), aligner};
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
  return "{" + pair("frames", counts.frames) + pair("alone", counts.alone) + pair("lost", counts.lost) +
         pair("spans", counts.spans) + pair("late", counts.late) + "\"longest\":[" + json(counts.longest[0]) + "," +
         json(counts.longest[1]) + "]," +
         line::format(
             "\"same\":%lu,\"different\":%lu,\"delays\":%lu,\"medianUs\":%lld,\"leastUs\":%lld,\"mostUs\":%lld,"
             "\"driftPpm\":%.3f,\"atZeroUs\":%.1f,\"laterUs\":%lld,\"evidence\":\"%s\","
             "\"ends\":\"%s\",\"areDelaysLate\":%s}",
             counts.same, counts.different, delays.count(), static_cast<long long>(delays.medianUs()),
             static_cast<long long>(delays.leastUs()), static_cast<long long>(delays.mostUs()), delays.driftPpm(),
             delays.at(0), static_cast<long long>(found.laterUs), found.aligner.evidence().c_str(), found.ends(counts).c_str(),
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
  comparing->aligner.finish();
  comparing->comparison.finish();
  words = json(*comparing, comparing->comparison.counts());
  comparing.reset();
  return words.c_str();
}

// Begins a comparison of live lines. B's time 0 is `laterUs` after A's.
EXPORT(compareLive)(double laterUs)->void {
  live = std::make_unique<Comparing>(static_cast<int64_t>(laterUs));
  live->aligner.knownUntil(0, live->timeOf(0, 0));
  live->aligner.knownUntil(1, live->timeOf(1, 0));
}

// The next records of a line, 0 or 1, are in the buffer, `size` bytes of them.
EXPORT(compareRecords)(unsigned side, unsigned size)->void {
  const auto *const records = reinterpret_cast<const Record *>(transfer);
  for (const Record *record = records; record != records + size / sizeof *record; record++) {
    if (record->kind <= static_cast<uint8_t>(Kind::Frame24)) {
      live->aligner.put(side, live->timeOf(side, record->endUs), valuesOf(*record),
                        static_cast<int64_t>(record->lateUs));
    }
  }
}

// No other record of that line comes up to this time of it.
EXPORT(comparedUntil)(unsigned side, double us)->void {
  live->aligner.knownUntil(side, live->timeOf(side, us) - LiveHeldUs);
}

// Returns what was found so far.
EXPORT(comparisonSoFar)()->const char * {
  words = json(*live, live->comparison.soFar());
  return words.c_str();
}
