// A recording that is read, and then handed over in parts to the instance that decodes it (FedLine.h).
#include <algorithm>
#include <cstring>
#include <memory>

#include "Scope.h"
#include "line/recording/Recording.h"

using namespace scope;

namespace {

line::LineSettings settings;
std::unique_ptr<line::RecordingReader> reader;
line::Recording tape;
std::string partOfLine;
std::string error;

}  // namespace

// The file's beginning is in the buffer, line::RecordingBeginning bytes of it.
EXPORT(openRecording)(unsigned count)->void {
  const std::string_view beginning = transferred(count);
  const bool csv = line::isCsvText(beginning);
  settings = csv ? line::csvSettings() : line::settingsIn(beginning);
  reader = std::make_unique<line::RecordingReader>(settings.characterUs(), csv);
}

EXPORT(recordingText)(unsigned count)->void {
  std::string_view text = transferred(count);
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
  tape = reader->finish();
  error = tape.errorLine > 0 ? "line " + std::to_string(tape.errorLine) + ": " : "";
  error += tape.error;
  return error.c_str();
}

EXPORT(recordingLengthUs)()->double {
  return static_cast<double>(tape.characters.back().endUs);
}
EXPORT(recordingSize)()->unsigned {
  return static_cast<unsigned>(tape.characters.size());
}

// When a character was complete.
EXPORT(recordingUs)(unsigned index)->double {
  return static_cast<double>(tape.characters[index].endUs);
}

// Writes how the line was set into the buffer. Returns the bytes.
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
