// Reads a file of any kind, as the command does. Its characters are handed over in parts to the instance that
// decodes them (FedLine.h).
#include "Tape.h"

#include <algorithm>
#include <cstring>
#include <deque>
#include <memory>

#include "ShownLine.h"
#include "line/capture/RecordedCapture.h"
#include "line/capture/SessionReader.h"
#include "line/file/FileHead.h"
#include "line/file/LineSplitter.h"
#include "line/recording/PlainText.h"

using namespace scope;

Tape scope::theTape;

namespace {

std::string &name = theTape.name;
line::LineSettings &settings = theTape.settings;
line::Recording &tape = theTape.recording;
line::FileHead head;
line::Overrides overrides;
std::unique_ptr<line::LineReader> reader;  // of a text and of bytes
std::unique_ptr<line::RecordedCapture> capture;
std::unique_ptr<line::CaptureText> captureText;  // of a capture
std::unique_ptr<line::SessionReader> session;    // of a capture that is one
std::string metadata;                            // of the session
std::string sessionError;                        // in its samples
line::PlainText plain;
line::LineSplitter lines;
std::deque<line::Character> came;
std::string error;  // in a line
std::string words;

constexpr size_t CharactersMost = 170000000;  // 17 hours of frames each 9 ms, which take 1.4 GB of memory

void keep() {
  for (const line::Character &character : came) {
    tape.characters.push_back(character);
  }
  came.clear();
  if (tape.characters.size() > CharactersMost && error.empty()) {
    error = "is longer than 17 hours, for which the page has memory: sbus summary and sbus csv can read it";
  }
}

constexpr const char *CutOff = "cut off within its last line: what was not whole is left out";
bool isCut = false;      // the last line has no LF: the power may have failed within it
bool isLeftOut = false;  // all of it was left out, or its last byte, since it was not whole

void takeCutLine(std::string_view text) {
  const bool isHalfByte = head.kind == line::FileKind::Recording && text.size() > 2 && text[text.size() - 2] == ' ';
  text.remove_suffix(isHalfByte ? 2 : 0);
  const std::string wrong = reader->cutLine(text, came);
  isCut = true;
  isLeftOut = isHalfByte || !wrong.empty() || (head.kind == line::FileKind::Rows && came.empty());
  keep();
}

// Takes the next piece of a text; an empty one is its end.
void takeLines(std::string_view text) {
  lines.put(text);
  for (std::string line; lines.take(line);) {
    if (error.empty() && lines.isCut() && lines.wrong().empty() && !tape.characters.empty()) {
      takeCutLine(line);
    } else if (error.empty()) {
      error = !lines.wrong().empty() ? lines.wrong()
              : lines.isCut()        ? reader->cutLine(line, came)
                                     : reader->line(line, came);
      error = error.empty() ? "" : "line " + std::to_string(lines.number()) + ": " + error;
      keep();
    }
  }
}

void takeText(std::string_view text) {
  if (captureText) {
    captureText->put(text);
  } else if (!text.empty()) {
    takeLines(text);
  }
}

// Returns what is wrong with a text or bytes.
std::string finishText() {
  takeText(plain.finish());
  takeLines({});
  const std::string missing = reader->finish(came);
  error = error.empty() && !isCut ? missing : error;
  if (isLeftOut || (isCut && !missing.empty())) {
    head.note += (head.note.empty() ? "" : ", ") + std::string(CutOff);
  }
  keep();
  tape.zeroUs = reader->zeroUs();
  return error.empty() ? "" : name + ": " + error;
}

line::CaptureEnd finishSession() {
  capture->wire().finish(session->endNs(), !sessionError.empty());
  return {session->format(), session->periodNs(), sessionError.empty() ? "" : name + ": " + sessionError, "", false};
}

// Returns why a capture cannot be played.
std::string finishCapture() {
  line::CaptureEnd end = session ? finishSession() : captureText->finish("");
  if (end.isCut && !capture->recording.characters.empty()) {
    end.error.clear();
    head.note = CutOff;
  }
  const std::string failure = capture->failure(name, end);
  if (failure.empty()) {
    settings = capture->settings();
    tape = std::move(capture->recording);
    const std::string note = capture->wire().note();
    head.note += (head.note.empty() || note.empty() ? "" : ", ") + note;
  }
  return failure;
}

int64_t ns(double us) { return static_cast<int64_t>(us * 1000) + capture->zeroNs(); }

// Returns the level in the middle of a bit of a character that begins at `startUs`.
bool isIdleAt(double startUs, int bit) {
  const int64_t atNs = ns(startUs + (bit + 0.5) * capture->wire().wire().bitNs / 1000);
  bool isHigh = false;
  capture->edges().each(atNs, atNs + 1, [&isHigh](int64_t, bool high) { isHigh = high; });
  return isHigh == settings.idleHigh();
}

}  // namespace

// The file's name is in the buffer.
EXPORT(nameFile)(unsigned count)->void { name = transferred(count); }

// The name of the signal to decode is in the buffer; without this call it is the best one.
EXPORT(chooseSignal)(unsigned count)->void { overrides.signal = transferred(count); }

// The file's beginning is in the buffer, line::FileHeadMax bytes of it or all. Returns why the page cannot read it, or
// "".
EXPORT(openFile)(unsigned count)->const char * {
  head = line::readFileHead(transferred(count), name);
  settings = head.settings;
  theTape.startUs = head.startUs;
  theTape.hasTimes = head.hasTimes;
  reader = line::makeReader(head, true);
  if (head.kind == line::FileKind::Capture) {
    capture = std::make_unique<line::RecordedCapture>(overrides, true);
    captureText = std::make_unique<line::CaptureText>(name, overrides, capture->wire());
  }
  words = head.error.empty() ? "" : name + ": " + head.error;
  return words.c_str();
}

// A session's metadata are in the buffer, or a part of them.
EXPORT(sessionMetadata)(unsigned count)->void { metadata += transferred(count); }

// After the metadata. Returns what is wrong with them, or "".
EXPORT(openSession)()->const char * {
  capture = std::make_unique<line::RecordedCapture>(overrides, true);
  session = std::make_unique<line::SessionReader>(capture->wire(), 0);
  words = metadata.empty() ? line::SessionReader::NoMetadata : session->metadata(metadata);
  words = words.empty() ? "" : name + ": " + words;
  return words.c_str();
}

// Returns the name of the entry with its samples, or the beginning of several names.
EXPORT(samplesName)()->const char * { return session->samplesName().c_str(); }
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

// The file's next bytes are in the buffer.
EXPORT(fileText)(unsigned count)->void {
  const std::string_view bytes = transferred(count);
  if (head.kind == line::FileKind::Bytes && error.empty()) {
    reader->line(bytes, came);
    keep();
  } else if (head.kind != line::FileKind::Bytes) {
    takeText(plain.put(bytes));
  }
}

// Returns what is wrong with the file, or "".
EXPORT(endFile)()->const char * {
  if (captureText) {
    takeText(plain.finish());
  }
  words = capture ? finishCapture() : finishText();
  return words.c_str();
}

// Returns what a user should know of the file, or "".
EXPORT(fileNote)()->const char * { return head.note.c_str(); }

// Returns what is wrong with its bytes and what to do, a line each; or "".
EXPORT(fileDamage)()->const char * {
  words = head.damage.empty() ? "" : head.damage + '\n' + head.damageRemedy;
  return words.c_str();
}

// Returns the file's own time at time 0 of its characters, in us: below 0 if it begins before its trigger.
EXPORT(recordingZeroUs)()->double { return static_cast<double>(tape.zeroUs); }

// Returns false if the times are not the line's: frames are assumed to be back to back.
EXPORT(recordingHasTimes)()->int { return theTape.hasTimes; }

// Returns when time 0 of the recording was, in us since 1970; 0 if it does not say so.
EXPORT(recordingStartUs)()->double { return static_cast<double>(theTape.startUs.value_or(0)); }

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

// Returns the signals of a capture that carry S.Bus, a line each: the decoded one first.
EXPORT(signals)()->const char * {
  words = capture ? capture->wire().signal() : "";
  for (const std::string &other : capture ? capture->wire().others() : std::vector<std::string>()) {
    words += "\n" + other;
  }
  return words.c_str();
}

// Writes the edges of a capture's wire from `fromUs` to `toUs` into the buffer: doubles, in us, each edge the other
// level. Returns how many, plus 0x10000 if the first leads to high; -1 if there are more than `most`: levels() shows
// them.
EXPORT(edges)(double fromUs, double toUs, unsigned most)->int {
  const line::EdgeStore &edges = capture->edges();
  const int64_t fromNs = ns(fromUs), toNs = ns(toUs);
  if (edges.approximateCount(fromNs, toNs) > most) {
    return -1;
  }
  int count = 0;
  bool isHigh = false;
  edges.each(fromNs, toNs, [&](int64_t edgeNs, bool high) {
    isHigh = count == 0 ? high : isHigh;
    const double us = static_cast<double>(edgeNs - capture->zeroNs()) / 1000;
    std::memcpy(transfer + sizeof us * static_cast<size_t>(count++), &us, sizeof us);
  });
  return count | (isHigh ? 0x10000 : 0);
}

// Writes which levels it had in each of `columns` parts of that time into the buffer: 1 low, 2 high, 3 both, 0 not
// known.
EXPORT(levels)(double fromUs, double toUs, unsigned columns)->void {
  capture->edges().levels(ns(fromUs), ns(toUs), transfer, columns);
}

// Returns up to when the edges are kept, in us; 0 if all are.
EXPORT(edgesEndUs)()->double {
  return capture->edges().isWhole() ? 0 : static_cast<double>(capture->edges().endNs() - capture->zeroNs()) / 1000;
}

EXPORT(bitUs)()->double { return capture->wire().wire().bitNs / 1000; }

// Writes the characters that end from `fromUs` on, `most` at most, into the buffer: of each two doubles, its beginning
// in us and its value, plus 256 for a wrong parity and 512 for a wrong stop bit. Returns how many.
EXPORT(characters)(double fromUs, unsigned most)->unsigned {
  const double lengthUs = capture->wire().wire().bitNs * settings.format.bits() / 1000;
  size_t at = 0;
  for (size_t end = tape.characters.size(); at < end;) {
    const size_t middle = (at + end) / 2;
    const bool isBefore = static_cast<double>(line::Character(tape.characters[middle]).endUs) < fromUs;
    (isBefore ? at : end) = isBefore ? middle + 1 : middle;
  }
  unsigned count = 0;
  for (; count < most && at < tape.characters.size(); at++, count++) {
    const line::Character character = tape.characters[at];
    double startUs = static_cast<double>(character.endUs) - lengthUs;
    const int64_t fromNs = ns(startUs);
    bool isFirst = true;
    capture->edges().each(fromNs, fromNs + 2000, [&](int64_t edgeNs, bool) {
      if (isFirst && edgeNs >= fromNs) {  // its end was rounded down to a microsecond
        isFirst = false;
        startUs = static_cast<double>(edgeNs - capture->zeroNs()) / 1000;
      }
    });
    const bool isParityWrong = character.bad && isIdleAt(startUs, 9) != line::isOdd(character.value);
    const bool isStopWrong = character.bad && !isIdleAt(startUs, 10);
    const double values[] = {startUs, character.value + (isParityWrong ? 256.0 : 0) + (isStopWrong ? 512.0 : 0)};
    std::memcpy(transfer + sizeof values * count, values, sizeof values);
  }
  return count;
}

// Returns when it ends, in us: with its last character, or with the capture.
EXPORT(recordingLengthUs)()->double {
  const double endUs = static_cast<double>(tape.characters.back().endUs);
  return capture ? std::max(endUs, static_cast<double>(capture->wire().endNs() - capture->zeroNs()) / 1000) : endUs;
}
EXPORT(recordingSize)()->unsigned { return static_cast<unsigned>(tape.characters.size()); }

// Returns when a character was complete.
EXPORT(recordingUs)(unsigned index)->double { return static_cast<double>(tape.characters[index].endUs); }

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
