// Reads a file: a recording, or a capture of the wire. Its characters are handed over in parts to the instance that
// decodes them (FedLine.h).
#include "Tape.h"

#include <algorithm>
#include <cstring>
#include <memory>

#include "Scope.h"
#include "line/capture/RecordedCapture.h"
#include "line/capture/SessionReader.h"
#include "line/recording/Recording.h"

using namespace scope;

Tape scope::theTape;

namespace {

std::string &name = theTape.name;
line::LineSettings &settings = theTape.settings;
line::Recording &tape = theTape.recording;
std::unique_ptr<line::RecordingReader> reader;
std::unique_ptr<line::RecordedCapture> capture;
std::unique_ptr<line::CaptureText> captureText;  // of a capture; no reader then
std::unique_ptr<line::SessionReader> session;    // of a capture that is one
std::string metadata;                            // of the session
std::string sessionError;                        // in its samples
std::string partOfLine;
std::string words;

// A sketch's rows may look like an oscilloscope's columns; rows with times are no capture.
bool isCapture(std::string_view head, bool isCsv) {
  if (head.substr(0, 8) == "<SALEAE>") {
    return true;  // its reader says that it cannot be read
  }
  const std::string format = line::captureFormat(head);
  const bool hasTimes = head.substr(0, 5) == "time," || head.substr(0, 8) == "seconds,";
  return !format.empty() && !hasTimes && !(isCsv && format == line::OscilloscopeFormat);
}

// Returns what is wrong with a recording.
std::string finishRecording() {
  if (!partOfLine.empty()) {
    reader->line(partOfLine);
  }
  tape = reader->finish();
  const std::string place = tape.errorLine > 0 ? "line " + std::to_string(tape.errorLine) + ": " : "";
  return tape.error.empty() ? "" : name + ": " + place + tape.error;
}

line::CaptureEnd finishSession() {
  capture->wire().finish(session->endNs(), !sessionError.empty());
  return {session->format(), session->periodNs(), sessionError.empty() ? "" : name + ": " + sessionError, ""};
}

// Returns why a capture cannot be played.
std::string finishCapture() {
  const std::string failure = capture->failure(name, session ? finishSession() : captureText->finish(""));
  if (failure.empty()) {
    settings = capture->settings();
    tape = std::move(capture->recording);
  }
  return failure;
}

}  // namespace

// The file's name is in the buffer.
EXPORT(nameFile)(unsigned count)->void {
  name = transferred(count);
}

// The file's beginning is in the buffer, line::CaptureHeadMax bytes of it.
EXPORT(openFile)(unsigned count)->void {
  const std::string_view head = transferred(count);
  const std::string_view beginning = head.substr(0, line::RecordingBeginning);
  const bool csv = line::isCsvText(beginning);
  if (isCapture(head, csv)) {
    capture = std::make_unique<line::RecordedCapture>();
    captureText = std::make_unique<line::CaptureText>(name, line::Overrules{}, capture->wire());
    return;
  }
  settings = csv ? line::csvSettings() : line::settingsIn(beginning);
  theTape.startUs = line::startIn(beginning);
  reader = std::make_unique<line::RecordingReader>(settings.characterUs(), csv);
}

// A session's metadata are in the buffer, or a part of them.
EXPORT(sessionMetadata)(unsigned count)->void {
  metadata += transferred(count);
}

// After the metadata. Returns what is wrong with them, or "".
EXPORT(openSession)()->const char * {
  capture = std::make_unique<line::RecordedCapture>();
  session = std::make_unique<line::SessionReader>(capture->wire(), 0);
  words = metadata.empty() ? line::SessionReader::NoMetadata : session->metadata(metadata);
  words = words.empty() ? "" : name + ": " + words;
  return words.c_str();
}

// Returns the name of the entry with its samples, or the beginning of several names.
EXPORT(samplesName)()->const char * {
  return session->samplesName().c_str();
}
// Returns what is wrong with a session that has no such entry.
EXPORT(noSamples)()->const char * {
  words = name + ": " + session->noSamples();
  return words.c_str();
}

// The session's next samples are in the buffer.
EXPORT(sessionSamples)(unsigned count)->void {
  if (sessionError.empty()) {
    sessionError = session->put(transferred(count));
  }
}

EXPORT(fileText)(unsigned count)->void {
  std::string_view text = transferred(count);
  if (captureText) {
    captureText->put(text);
    return;
  }
  for (size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
    partOfLine += text.substr(0, end);
    reader->line(partOfLine);
    partOfLine.clear();
    text.remove_prefix(end + 1);
  }
  // A reader rejects longer lines: what is after that need not be kept.
  partOfLine += text.substr(0, line::RecordingLineMax + 1 - std::min(partOfLine.size(), line::RecordingLineMax));
}

// Returns what is wrong with the file, or "".
EXPORT(endFile)()->const char * {
  words = capture ? finishCapture() : finishRecording();
  return words.c_str();
}

// Returns what carries the line in a capture, or "".
EXPORT(carrier)()->const char * {
  words = "";
  if (capture) {
    const line::WireDecoder &wire = capture->wire();
    words = "signal " + wire.signal() + (wire.wire().frames > 0 ? "" : ", without a frame") +
            (wire.isMeasured() ? ", " + text(wire.wire().settings) : "");
  }
  return words.c_str();
}

EXPORT(recordingLengthUs)()->double {
  return static_cast<double>(tape.characters.back().endUs);
}
EXPORT(recordingSize)()->unsigned {
  return static_cast<unsigned>(tape.characters.size());
}

// Returns when a character was complete.
EXPORT(recordingUs)(unsigned index)->double {
  return static_cast<double>(tape.characters[index].endUs);
}

// Writes the line's settings into the buffer. Returns their bytes.
EXPORT(recordingSettings)()->unsigned {
  std::memcpy(transfer, &settings, sizeof settings);
  return sizeof settings;
}

// Writes the next characters into the buffer, FedLine::PartMax at most. Returns the bytes.
EXPORT(recordingPart)(unsigned from)->unsigned {
  const size_t count = std::min(tape.characters.size() - from, FedLine::PartMax);
  for (size_t i = 0; i < count; i++) {
    const line::Character character = tape.characters[from + i];
    std::memcpy(transfer + i * sizeof character, &character, sizeof character);
  }
  return static_cast<unsigned>(count * sizeof(line::Character));
}
