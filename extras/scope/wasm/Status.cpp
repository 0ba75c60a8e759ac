// The figures of the whole line.
#include <algorithm>

#include "ShownLine.h"

namespace scope {

// The page reads it, by border.mjs.
struct Status {
  double state;
  double showsLostFrame;
  double showsFailsafe;
  double ageUs;
  double linkQuality;  // percent; only for frames
  double framesPerSecond;
  double gapMinUs;
  double gapMeanUs;
  double gapMaxUs;
  double characters;
  double characterErrors;
  double frames;
  double lostFrames;
  double failsafeFrames;
  double rejectedByEnd;
  double rejectedByFlags;
  double rejectedByLength;
  double discardedBytes;
  double resyncs;
  double extraFrames;
  double rows;
  double otherLines;
  double garbled;
  double lateUs;        // that the PC is late; 0 if it is less than 0.1 s
  double lateReads;     // of a port: those that were 0.1 s late or more
  double quietUs;       // since the newest character
  double finding;       // of the last whole second of the line's time; -1 before the first is over
  double hadFrames;     // by the end of that second
  double findingSoFar;  // of all that has come
};

}  // namespace scope

using namespace scope;

namespace {

Status answer;

double marks[2];

// Returns the finding for the port's present setting, from all that came since it was opened, or since mark().
sbus::Finding findingSoFar(uint64_t nowUs) {
  sbus::Diagnosis diagnosis;
  diagnosis.add(shownLine.examination.trial(shownLine.observer, shownLine.settings, nowUs));
  return diagnosis.finding();
}

}  // namespace

EXPORT(status)(double now)->const Status * {
  const uint64_t nowUs = shownLine.knownUs(static_cast<uint64_t>(now));
  line::Observer &observer = shownLine.observer;
  const sbus::Counters &counters = observer.counters();
  BoardRows &rows = shownLine.rows;
  const bool text = rows.recognised();
  const line::Extent &gaps = text ? rows.gaps() : observer.gaps();
  const auto d = [](uint64_t value) { return static_cast<double>(value); };
  answer.state = d(static_cast<uint64_t>(shownLine.state(nowUs)));
  answer.showsLostFrame = text ? rows.showsLostFrame(nowUs) : observer.showsLostFrame(nowUs);
  answer.showsFailsafe = text ? rows.showsFailsafe(nowUs) : observer.showsFailsafe(nowUs);
  answer.ageUs = d(text ? rows.ageUs(nowUs) : observer.ageUs(nowUs));
  answer.linkQuality = d(observer.linkQuality(nowUs));
  answer.framesPerSecond = d(text ? rows.perSecond(nowUs) : observer.perSecond(nowUs));
  answer.gapMinUs = d(gaps.low);
  answer.gapMeanUs = d(gaps.mean());
  answer.gapMaxUs = d(gaps.high);
  answer.characters = d(observer.characters());
  answer.characterErrors = d(observer.characterErrors());
  answer.frames = d(counters.frames);
  answer.lostFrames = d(counters.lostFrames);
  answer.failsafeFrames = d(counters.failsafeFrames);
  answer.rejectedByEnd = d(counters.rejectedByEnd);
  answer.rejectedByFlags = d(counters.rejectedByFlags);
  answer.rejectedByLength = d(counters.rejectedByLength);
  answer.discardedBytes = d(observer.discardedBytes());
  answer.resyncs = d(counters.resyncs);
  answer.extraFrames = d(counters.extraFrames);
  answer.rows = d(rows.count());
  answer.otherLines = d(rows.otherLines());
  answer.garbled = d(rows.garbled());
  answer.lateUs = now - d(nowUs);
  answer.lateReads = d(shownLine.lateReads());
  answer.quietUs = d(nowUs - std::min(nowUs, shownLine.characterUs()));
  answer.finding = shownLine.verdict.finding() ? d(static_cast<uint64_t>(*shownLine.verdict.finding())) : -1;
  answer.hadFrames = shownLine.verdict.hadFrames();
  answer.findingSoFar = d(static_cast<uint64_t>(findingSoFar(nowUs)));
  return &answer;
}

// Returns what sensors have measured, after the slots that came, within the last second, a line each: its place among a
// record's readings, name, value and unit with tabs between. "" without telemetry.
EXPORT(telemetry)(double now)->const char * {
  static std::string lines;
  const auto nowUs = static_cast<uint64_t>(now);
  const uint64_t sinceUs = nowUs - std::min(nowUs, line::Readings::FreshUs);
  lines = shownLine.readings.slots(sinceUs);
  shownLine.readings.each(sinceUs, [](const line::Quantity &quantity, double) {
    lines += "\n" + std::to_string(readingOf(quantity)) + '\t' + quantity.name + '\t' + quantity.value + '\t' +
             quantity.unit;
  });
  return lines.c_str();
}

// Returns all sensors, a line each: name and how many slots.
EXPORT(sensorNames)()->const char * {
  static std::string names;
  names.clear();
  for (const line::Sensor &sensor : line::sensors()) {
    names += sensor.name + (" " + std::to_string(sensor.slots)) + "\n";
  }
  return names.c_str();
}

// The sensors of the line are in the buffer: of each the first slot, and its number among sensorNames().
EXPORT(setSensors)(unsigned count)->void {
  shownLine.sensors.clear();
  for (unsigned i = 0; i + 1 < count; i += 2) {
    shownLine.sensors[transfer[i]] = &line::sensors()[transfer[i + 1]];
  }
  shownLine.readings = line::Readings(shownLine.sensors);
}

// Returns the least and greatest value of a channel, from 0 on; nullptr before the first.
EXPORT(travel)(unsigned channel)->const double * {
  if (shownLine.rows.recognised()) {
    const BoardRows::Travel *const travel = shownLine.rows.travel(channel);
    marks[0] = travel != nullptr ? travel->low : 0;
    marks[1] = travel != nullptr ? travel->high : 0;
    return travel != nullptr ? marks : nullptr;
  }
  const line::Extent &travel = shownLine.observer.travel(channel);
  marks[0] = static_cast<double>(travel.low);
  marks[1] = static_cast<double>(travel.high);
  return travel.count > 0 ? marks : nullptr;
}

EXPORT(resetMarks)()->void {
  shownLine.observer.resetMarks();
  shownLine.rows.resetMarks();
}
