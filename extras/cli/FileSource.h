// Reads the line that a file holds: a recording, a sketch's rows, a capture of the wire, or bytes without times.
#pragma once

#include <string>

#include "line/simulation/LineSettings.h"
#include "line/recording/Recording.h"

namespace tool {

enum class FileKind { Recording, Rows, Capture, Bytes };

// Returns the kind of the file, by its beginning; raw bytes by the name, FILE.bin or FILE.raw. Throws
// std::runtime_error for any other file; a file that cannot be opened counts as a recording.
FileKind kindOfFile(const std::string &name);

struct FileSource {
  FileKind kind = FileKind::Recording;
  line::Recording recording;
  line::LineSettings settings;  // of the line; a capture's are those found on the wire
};

// Reads the whole file. `baud` is the line's; 0: what the file says, or 100000. Throws std::runtime_error, which names
// the place, if the file cannot be read or is wrong. Says on standard error if the times are not known.
FileSource readFile(const std::string &name, unsigned long baud = 0);

}  // namespace tool
