// Chooses the line that the page shows, and reads it.
#include <algorithm>
#include <cstring>

#include "ShownLine.h"
#include "line/Silence.h"

using namespace scope;

namespace {

std::string words;

line::LineSettings settings(double baud, bool inverted) {
  line::LineSettings settings;
  settings.baud = static_cast<unsigned long>(baud);
  settings.polarity = inverted ? line::Polarity::Inverted : line::Polarity::Uninverted;
  return settings;
}

uint64_t us(double nowUs) { return nowUs > 0 ? static_cast<uint64_t>(nowUs) : 0; }

void begin(double nowUs, const line::LineSettings &settings) {
  shownLine.simulated.reset();
  shownLine.played.reset();
  shownLine.reset(us(nowUs), settings);
}

}  // namespace

EXPORT(transferBuffer)()->uint8_t * { return transfer; }

EXPORT(openSimulated)(int calibration, int channels, unsigned noise, double baud, int inverted)->void {
  const line::LineSettings line = settings(baud, inverted != 0);
  begin(0, line);
  shownLine.simulated =
      std::make_unique<SimulatedLine>(calibration != 0 ? line::Sticks::Calibration : line::Sticks::Flight,
                                      channels == 24   ? line::Channels::TwentyFour
                                      : channels == 32 ? line::Channels::ThirtyTwo
                                                       : line::Channels::Sixteen,
                                      noise, line);
}

// Sets the port that reads the simulated line.
EXPORT(setPort)(double nowUs, double baud, int inverted)->void {
  const line::LineSettings port = settings(baud, inverted != 0);
  shownLine.reset(us(nowUs), port);
  if (shownLine.simulated) {
    shownLine.simulated->setPort(us(nowUs), port);
  }
}

EXPORT(cutWire)(int cut)->void {
  if (shownLine.simulated) {
    shownLine.simulated->cut(cut != 0);
  }
}

EXPORT(openPort)(double nowUs, double baud, int board)->void {
  line::LineSettings port = board != 0 ? line::csvSettings() : settings(baud, true);
  port.baud = static_cast<unsigned long>(baud);
  begin(nowUs, port);
}

EXPORT(received)(unsigned count, double nowUs)->void { shownLine.received(transfer, count, us(nowUs)); }
EXPORT(receivedBad)(double nowUs)->void { shownLine.receivedBad(us(nowUs)); }

// Plays a recording. The line's settings are in the buffer (recordingSettings()).
EXPORT(playRecording)()->void {
  line::LineSettings settings;
  std::memcpy(static_cast<void *>(&settings), transfer, sizeof settings);
  begin(0, settings);
  shownLine.played = std::make_unique<FedLine>();
}

// Its next characters are in the buffer, `size` bytes of them (recordingPart()).
EXPORT(feed)(unsigned size, int areLast)->void {
  shownLine.played->feed(reinterpret_cast<const line::Character *>(transfer), size / sizeof(line::Character),
                         areLast != 0);
}
EXPORT(needsMore)()->int { return shownLine.played && shownLine.played->needsMore(); }

// Takes all that has come by `nowUs`. Returns how many records there are then. If there are ShownLine::Enough, call it
// again once they are taken away; if needsMore(), once it is fed.
EXPORT(advance)(double nowUs)->unsigned {
  shownLine.advance(us(nowUs));
  return static_cast<unsigned>(shownLine.records.size());
}

EXPORT(records)()->const Record * { return shownLine.records.data(); }
// Makes the records that the page shows once more. Returns how many they are.
EXPORT(recall)()->unsigned {
  shownLine.recall();
  return static_cast<unsigned>(shownLine.records.size());
}
EXPORT(takenRecords)()->void { shownLine.records.clear(); }

// The steps of a condition are in the buffer; without any the page watches for nothing. Returns true if it may become
// true while nothing comes.
EXPORT(watchFor)(unsigned size)->int {
  std::optional<line::Condition> condition;
  if (size > 0) {
    const auto *const steps = reinterpret_cast<const line::Condition::Step *>(transfer);
    condition.emplace(steps, steps + size / sizeof *steps);
  }
  const bool needsTime = condition && condition->needsTime();
  shownLine.watchFor(std::move(condition));
  return needsTime;
}

// Returns a line::Gap. Times in us; the line counts as silent after `limitUs`, which may be infinite.
EXPORT(gapOf)(double beforeUs, double nowUs, double lateUs, double limitUs)->int {
  return static_cast<int>(line::gapOf(us(beforeUs), us(nowUs), us(lateUs), us(std::min(limitUs, 1e15))));
}

// Begins or ends a recording.
EXPORT(record)(int on)->void { shownLine.record(on != 0); }

// Returns what was recorded since the last call.
EXPORT(takeRecorded)()->const char * {
  words = shownLine.recorder.take();
  return words.c_str();
}
