#include "line/Source.h"

#include <sys/stat.h>

#include <stdexcept>
#include <utility>

#include "line/recording/RecordedLine.h"
#include "line/recording/RecordingFile.h"
#include "line/recording/RestoredLine.h"
#include "line/recording/Words.h"
#include "line/simulation/NoisyLine.h"
#include "line/simulation/SimulatedBus.h"

namespace line {

namespace {

constexpr uint64_t SketchLeadUs = 1000;

// An original SBS-01V: 5.6 V and 12.5 V, github.com/dgatf/msrc/issues/173.
constexpr BusSensor ExampleSensor[] = {{1, {0x80, 0x38}}, {2, {0x00, 0x7D}}};

constexpr unsigned NoiseMax = 100000;

// Takes a word. Returns false if it is not a word of sim or of a file.
bool takeSourceWord(const std::string &word, Source &source) {
  if (word == "uninverted") {
    source.settings.polarity = Polarity::Uninverted;
  } else if (word.rfind("noise=", 0) == 0) {
    return parseWhole(std::string_view(word).substr(6), source.noise) && source.noise >= 1 && source.noise <= NoiseMax;
  } else if (!source.isSimulated()) {
    return false;
  } else if (word == "16" || word == "24" || word == "32") {
    source.channels = word == "24" ? Channels::TwentyFour : word == "32" ? Channels::ThirtyTwo : Channels::Sixteen;
  } else if (word == "sbus2") {
    source.sbus2 = true;
  } else if (word == "silent") {
    source.silent = true;
  } else if (word == "calibration") {
    source.sticks = Sticks::Calibration;
  } else {
    return false;
  }
  return true;
}

bool exists(const std::string &name) {
  struct stat status;
  return stat(name.c_str(), &status) == 0;
}

// Takes the words after the colon. Returns what is wrong with the first wrong one, or "". `known` lists the words.
std::string takeSourceWords(const std::string &words, const char *known, Source &source) {
  std::string wrong;
  forEachBetweenCommas(words, [&](std::string_view each) {
    const std::string word = lower(withoutBlanks(each));
    if (wrong.empty() && !takeSourceWord(word, source)) {
      wrong = quoted(word) + " is not allowed after the colon; " + known;
    }
  });
  return wrong;
}

}  // namespace

// A file name may itself contain a colon.
Source parseSource(const std::string &text) {
  const size_t colon = text.rfind(':');
  Source source;
  const bool isSim = text.substr(0, text.find(':')) == "sim" && !exists(text);
  source.name = isSim ? "" : text;
  if (colon == std::string::npos || (!isSim && (exists(text) || !exists(text.substr(0, colon))))) {
    return source;
  }
  source.name = isSim ? "" : text.substr(0, colon);
  const std::string wrong =
      takeSourceWords(text.substr(isSim ? 4 : colon + 1),
                      isSim ? "there are 16, 24, 32, sbus2, silent, calibration, noise=1 to noise=100000 and "
                              "uninverted, such as sim:24,noise=30"
                            : "there are noise=1 to noise=100000 and uninverted",
                      source);
  if (!wrong.empty()) {
    throw std::runtime_error(text + ": " + wrong);
  }
  return source;
}

std::unique_ptr<Line> Source::open() const {
  std::unique_ptr<Line> line;
  if (!isSimulated()) {
    Recording read = readRecording(name, settings.characterUs());
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
  return !isSimulated()                     ? "recording " + name + ", once"
         : silent                           ? "a line with nothing on it"
         : sbus2                            ? "simulated Futaba receiver with S.BUS2, an SBS-01V in slot 1"
         : channels == Channels::TwentyFour ? "simulated FrSky receiver with 24 channels"
         : channels == Channels::ThirtyTwo  ? "simulated Futaba receiver, FASSTest 26"
                                            : "simulated FrSky R-XSR";
}

}  // namespace line
