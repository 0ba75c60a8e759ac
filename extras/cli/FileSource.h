// Finds out what a file holds: a recording, a sketch's rows, JSON lines, a table of frames, a capture of the wire, or
// bytes without times.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "cli/TextLine.h"
#include "line/LineSettings.h"
#include "line/capture/Overrides.h"
#include "line/capture/WireDecoder.h"
#include "line/recording/Recording.h"

namespace tool {

enum class FileKind { Recording, Rows, Capture, Bytes, Json, Table };

// A file's path, and its name in messages.
struct FileName {
  FileName(const std::string &name) : path(name), shown(name) {}  // implicit: most files have one name
  FileName(std::string where, std::string name) : path(std::move(where)), shown(std::move(name)) {}

  std::string path;
  std::string shown;
};

// Returns the kind of the text that begins with `head`, at least RecordingBeginning characters unless it is shorter.
// Throws std::runtime_error for any other text.
FileKind kindOfText(const std::string &head, const std::string &name);

// Prints to standard error which signal was chosen, if others carry S.Bus as well.
void reportSignal(const std::string &name, const line::WireDecoder &wire);

struct FileSource {
  FileKind kind = FileKind::Recording;
  line::LineSettings settings;     // the line's; a capture's were measured on the wire
  bool hasTimes = true;            // its times are the line's
  bool hasRowTimes = true;         // a sketch's rows have a column of times
  bool isLate = false;             // it was recorded at a port that delivers characters late
  std::string signal;              // a capture's
  std::optional<int64_t> startUs;  // time 0 in us since 1970, if the file gives it
  line::Recording recording;       // of a capture and of bytes; other files are read while they are played
  bool isRead = false;             // its frames say when they were read
  std::string path;                // of those other files

  bool isWhole() const { return kind == FileKind::Capture || kind == FileKind::Bytes; }
};

// Reads a capture or bytes, or the head of another file, packed or not: see line::PackedFile. `overrides`: what the
// user knows better than the file. Throws std::runtime_error with the place if the file cannot be read or is wrong.
// Prints to standard error if the times are unknown, and which signal of a capture was chosen if several carry S.Bus.
FileSource readFile(const FileName &name, const line::Overrides &overrides = {});

// Does the same for a text of this kind from a pipe, given its beginning.
FileSource headOfPipe(FileKind kind, const std::string &head, unsigned long baud);

// Returns the reader for the lines of a file that is read while it is played.
std::unique_ptr<LineReader> makeReader(const FileSource &source);

// Returns the kind of a text that can be read while it is being written, recognised by its beginning: JSON lines, a
// table of frames, or a recording that sbus writes. Returns nothing while it is uncertain.
std::optional<FileKind> liveKind(const std::string &begin);

}  // namespace tool
