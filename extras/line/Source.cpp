#include "line/Source.h"

#include <utility>

#include "line/simulation/NoisyLine.h"
#include "line/recording/RecordedLine.h"
#include "line/recording/RecordingFile.h"
#include "line/recording/RestoredLine.h"
#include "line/simulation/SilentLine.h"
#include "line/simulation/SimulatedBus.h"

namespace line {

namespace {

constexpr uint64_t SketchLeadUs = 1000;

// An original SBS-01V: 5.6 V and 12.5 V, github.com/dgatf/msrc/issues/173.
constexpr BusSensor ExampleSensor[] = {{1, {0x80, 0x38}}, {2, {0x00, 0x7D}}};

}  // namespace

std::unique_ptr<Line> Source::open() const {
  std::unique_ptr<Line> line;
  if (!recording.empty()) {
    Recording read = readRecording(recording, settings.characterUs());
    const bool isLate = read.characters.isLate();
    line = std::make_unique<RecordedLine>(std::move(read), isForSketch ? SketchLeadUs : 0);
    if (isLate && isForSketch) {
      line = std::make_unique<RestoredLine>(std::move(line), settings.characterUs());
    }
  } else if (silent) {
    line = std::make_unique<SilentLine>();
  } else if (sbus2) {
    auto bus = std::make_unique<SimulatedBus>(choreography(sticks));
    for (const BusSensor &sensor : ExampleSensor) {
      bus->add(sensor);
    }
    line = std::move(bus);
  } else {
    line = std::make_unique<SimulatedReceiver>(choreography(sticks), settings.characterUs(), channels);
  }
  if (noise > 0) {
    line = std::make_unique<NoisyLine>(std::move(line), noise, settings.characterUs());
  }
  return line;
}

std::string Source::text() const {
  return !recording.empty()                 ? "recording " + recording + ", once"
         : silent                           ? "a line with nothing on it"
         : sbus2                            ? "simulated Futaba receiver with S.BUS2, an SBS-01V in slot 1"
         : channels == Channels::TwentyFour ? "simulated FrSky receiver of 24 channels"
         : channels == Channels::ThirtyTwo  ? "simulated Futaba receiver, FASSTest 26"
                                            : "simulated FrSky R-XSR";
}

}  // namespace line
