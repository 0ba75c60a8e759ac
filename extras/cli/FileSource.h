// Finds out what line a file holds: a recording, a sketch's rows, JSON lines, a table of frames, a capture of the wire,
// or bytes without times.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "cli/TextLine.h"
#include "line/LineSettings.h"
#include "line/capture/Overrules.h"
#include "line/capture/WireDecoder.h"
#include "line/recording/Recording.h"

namespace tool {

enum class FileKind { Recording, Rows, Capture, Bytes, Json, Table };

// A file: where it is, and what messages call it.
struct FileName {
  FileName(const std::string &name) : path(name), shown(name) {}  // implicit: most files have one name
  FileName(std::string where, std::string name) : path(std::move(where)), shown(std::move(name)) {}

  std::string path;
  std::string shown;
};

// Returns the kind of text that begins with `head`, RecordingBeginning characters or more unless it is shorter. Throws
// std::runtime_error for any other text.
FileKind kindOfText(const std::string &head, const std::string &name);

// Says on standard error which signal was chosen, if others carry S.Bus as well.
void saySignal(const std::string &name, const line::WireDecoder &wire);

struct FileSource {
  FileKind kind = FileKind::Recording;
  line::LineSettings settings;     // of the line; a capture's are those found on the wire
  bool hasTimes = true;            // its times are those of the line
  bool hasRowTimes = true;         // the rows of a sketch have a column of times
  bool isLate = false;             // a port has brought the characters late
  std::string signal;              // of a capture
  std::optional<int64_t> startUs;  // when time 0 was, in us since 1970, if the file says it
  line::Recording recording;       // of a capture and of bytes; other files are read while they are played
  std::string path;                // of these

  bool isWhole() const { return kind == FileKind::Capture || kind == FileKind::Bytes; }
};

// Reads a capture or bytes, or the head of another file, packed or not: see line::PackedFile. `overrules` is what the
// user knows of the line better than the file. Throws std::runtime_error, which names the place, if the file cannot be
// read or is wrong. Says on standard error if the times are not known, and which signal of a capture was chosen, if
// several carry S.Bus.
FileSource readFile(const FileName &name, const line::Overrules &overrules = {});

// Returns the same of a text of this kind that a pipe brings, by its beginning.
FileSource headOfPipe(FileKind kind, const std::string &head, unsigned long baud);

// Returns what reads the lines of a file that is not whole.
std::unique_ptr<LineReader> makeReader(const FileSource &source);

// Returns the kind of a text that shows itself by its beginning, and can be read while it is being written: JSON lines,
// a table of frames, or a recording that sbus writes; nothing as long as that is not certain.
std::optional<FileKind> liveKind(const std::string &begin);

}  // namespace tool
