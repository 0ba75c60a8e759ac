#include "line/Source.h"

#include <utility>

#include "line/simulation/NoisyLine.h"
#include "line/recording/RecordedLine.h"
#include "line/recording/RecordingFile.h"
#include "line/recording/RestoredLine.h"
#include "line/simulation/SilentLine.h"

namespace line {

namespace {

constexpr uint64_t SketchLeadUs = 1000;

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
         : channels == Channels::TwentyFour ? "simulated FrSky receiver of 24 channels"
         : channels == Channels::ThirtyTwo  ? "simulated Futaba receiver, FASSTest 26"
                                            : "simulated FrSky R-XSR";
}

}  // namespace line
