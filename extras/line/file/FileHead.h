// Decides by a file's beginning what it is, for every subcommand and the page, and makes the reader of its text.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "line/LineSettings.h"
#include "line/file/LineReader.h"

namespace line {

// Capture: a recording of the wire, for CaptureText. Rows: a sketch's. Table: a frame a row. Decoded: what
// `sbus decode` or `sbus hex` prints. Bytes are raw; Text: bytes as text. Wrong: see FileHead::error.
enum class FileKind { Recording, Rows, Capture, Bytes, Text, Json, Table, Decoded, Wrong };

struct FileHead {
  FileKind kind = FileKind::Recording;
  std::string error;               // why it cannot be read, and what to do
  LineSettings settings;           // the line's; a capture's are measured on the wire
  bool hasTimes = true;            // its times are the line's
  bool hasRowTimes = true;         // a sketch's rows have a column of times
  bool isLate = false;             // it was recorded at a port that delivers characters late
  bool isRead = false;             // its frames say when they were read
  std::optional<int64_t> startUs;  // time 0 in us since 1970, if the file gives it
  int64_t zeroUs = 0;              // see LineReader::zeroUs()
  std::string note;                // what a user should know of it
  std::string damage;              // of bytes: what another program did to them: a finding
  std::string damageRemedy;        // what to do
  std::string begin;               // the beginning that was examined
};

// Examines a file's first bytes, FileHeadMax of them or all. `name`: the file's. `baud` overrides the file's; 0: the
// file's.
FileHead readFileHead(std::string_view begin, const std::string &name, unsigned long baud = 0);

// Returns the kind of a text, by its beginning.
FileKind kindOfText(std::string_view text);

// Returns what a file of this kind, which begins so, is if it is surely no capture; otherwise nothing.
std::string whyNoCapture(FileKind kind, std::string_view begin);

// Returns the head of a text of a known kind.
FileHead headOfText(FileKind kind, std::string_view begin, unsigned long baud = 0);

// Returns the reader for a text or for bytes; nullptr for a capture, and if it is wrong. `isWhole`: see
// RecordingReader.
std::unique_ptr<LineReader> makeReader(const FileHead &head, bool isWhole = false);

// Returns the kind of a text that can be read while it is being written, recognised by its beginning: JSON lines, a
// table of frames, or a recording that sbus writes. Returns nothing while it is uncertain.
std::optional<FileKind> liveKind(const std::string &begin);

// Returns which export to choose if only its own program can read a file: by its first bytes, by an entry of a ZIP, or
// by its name; otherwise nothing.
std::string exportOf(std::string_view begin, const std::string &name);

}  // namespace line
