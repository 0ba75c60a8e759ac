// What a file holds of a line: a recording, a sketch's rows, a capture of the wire, or bytes without times.
#pragma once

#include <string>

#include "line/simulation/LineSettings.h"
#include "line/recording/Recording.h"

namespace tool {

enum class FileKind { Recording, Rows, Capture, Bytes };

// Returns what the file is, told from its beginning and, of raw bytes, from its name: FILE.bin or FILE.raw. Throws
// std::runtime_error if it is none of these; a file that cannot be opened is taken for a recording.
FileKind kindOfFile(const std::string &name);

struct FileSource {
  FileKind kind = FileKind::Recording;
  line::Recording recording;
  line::LineSettings settings;  // of the line: of a capture as they were found on the wire
};

// Reads the whole file. `baud`: of the line; 0: what the file says, or 100000. Throws std::runtime_error, which names
// the place, if it cannot be read or something is wrong with it. Says on standard error if times are not known.
FileSource readFile(const std::string &name, unsigned long baud = 0);

}  // namespace tool
