// Which line the page looks at, and what it brings.
#include <algorithm>
#include <utility>

#include "Scope.h"

using namespace scope;

namespace {

uint8_t buffer[TransferSize];  // what the page hands over: bytes of a port, text of a recording
std::unique_ptr<line::RecordingReader> reader;
line::LineSettings readSettings;
line::Recording read;  // to be played
std::string partOfLine;
std::string words;

line::LineSettings settings(double baud, bool inverted) {
  line::LineSettings settings;
  settings.baud = static_cast<unsigned long>(baud);
  settings.polarity = inverted ? line::Polarity::Inverted : line::Polarity::Uninverted;
  return settings;
}

uint64_t us(double nowUs) {
  return nowUs > 0 ? static_cast<uint64_t>(nowUs) : 0;
}

void begin(double nowUs, const line::LineSettings &settings) {
  theScope.simulated.reset();
  theScope.played.reset();
  theScope.reset(us(nowUs), settings);
}

}  // namespace

EXPORT(transferBuffer)()->uint8_t * {
  return buffer;
}

EXPORT(openSimulated)(int calibration, int channels, unsigned noise, double baud, int inverted)->void {
  const line::LineSettings line = settings(baud, inverted != 0);
  begin(0, line);
  theScope.simulated =
      std::make_unique<SimulatedLine>(calibration != 0 ? line::Sticks::Calibration : line::Sticks::Flight,
                                      channels == 24   ? line::Channels::TwentyFour
                                      : channels == 32 ? line::Channels::ThirtyTwo
                                                       : line::Channels::Sixteen,
                                      noise, line);
}

// Of the simulated line: how the port reads it.
EXPORT(setPort)(double nowUs, double baud, int inverted)->void {
  const line::LineSettings port = settings(baud, inverted != 0);
  theScope.reset(us(nowUs), port);
  if (theScope.simulated) {
    theScope.simulated->setPort(us(nowUs), port);
  }
}

EXPORT(cutWire)(int cut)->void {
  if (theScope.simulated) {
    theScope.simulated->cut(cut != 0);
  }
}

EXPORT(openPort)(double nowUs, double baud, int board)->void {
  line::LineSettings port = board != 0 ? line::csvSettings() : settings(baud, true);
  port.baud = static_cast<unsigned long>(baud);
  begin(nowUs, port);
}

EXPORT(received)(unsigned count, double nowUs)->void {
  theScope.received(buffer, count, us(nowUs));
}
EXPORT(receivedBad)(double nowUs)->void {
  theScope.receivedBad(us(nowUs));
}

// The file's beginning is in the buffer, line::RecordingBeginning bytes of it.
EXPORT(openRecording)(unsigned count)->void {
  const std::string_view beginning(reinterpret_cast<const char *>(buffer), count);
  const bool csv = line::isCsvText(beginning);
  readSettings = csv ? line::csvSettings() : line::settingsIn(beginning);
  reader = std::make_unique<line::RecordingReader>(readSettings.characterUs(), csv);
  partOfLine.clear();
}

EXPORT(recordingText)(unsigned count)->void {
  std::string_view text(reinterpret_cast<const char *>(buffer), count);
  for (size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
    partOfLine += text.substr(0, end);
    reader->line(partOfLine);
    partOfLine.clear();
    text.remove_prefix(end + 1);
  }
  // A reader rejects longer lines: what is after that need not be kept.
  partOfLine += text.substr(0, line::RecordingLineMax + 1 - std::min(partOfLine.size(), line::RecordingLineMax));
}

// What is wrong with it, or "".
EXPORT(endRecording)()->const char * {
  if (!partOfLine.empty()) {
    reader->line(partOfLine);
  }
  read = reader->finish();
  reader.reset();
  words = read.errorLine > 0 ? "line " + std::to_string(read.errorLine) + ": " : "";
  words += read.error;
  if (!read.error.empty()) {
    read = line::Recording();
  }
  return words.c_str();
}

// What was read takes the place of the line that there was.
EXPORT(playRecording)()->void {
  begin(0, readSettings);
  theScope.played = std::make_unique<PlayedLine>(std::exchange(read, {}));
}

EXPORT(recordingLengthUs)()->double {
  return theScope.played ? static_cast<double>(theScope.played->lengthUs()) : 0;
}

// To the recording's beginning.
EXPORT(rewindRecording)()->void {
  theScope.reset(0, theScope.settings);
  if (theScope.played) {
    theScope.played->rewind();
  }
}

// How many records there are then. If there are Scope::Enough, call it again once they are taken away.
EXPORT(advance)(double nowUs)->unsigned {
  theScope.advance(us(nowUs));
  return static_cast<unsigned>(theScope.records.size());
}

EXPORT(records)()->const Record * {
  return theScope.records.data();
}
EXPORT(takenRecords)()->void {
  theScope.records.clear();
}

EXPORT(record)(int on)->void {
  theScope.record(on != 0);
}

// What was recorded since this was last asked.
EXPORT(takeRecorded)()->const char * {
  words = theScope.recorder.take();
  return words.c_str();
}
