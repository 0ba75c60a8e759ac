// Reads the line that a file holds: a recording, a sketch's rows, a capture of the wire, or bytes without times.
#pragma once

#include <string>
#include <utility>

#include "line/capture/Overrules.h"
#include "line/capture/WireDecoder.h"
#include "line/recording/Recording.h"
#include "line/simulation/LineSettings.h"

namespace tool {

enum class FileKind { Recording, Rows, Capture, Bytes };

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
  line::Recording recording;
  line::LineSettings settings;  // of the line; a capture's are those found on the wire
};

// Reads the whole file, packed or not: see line::PackedFile. `overrules` is what the user knows of the line better than
// the file. Throws std::runtime_error, which names the place, if the file cannot be read or is wrong. Says on standard
// error if the times are not known, and which signal of a capture was chosen, if several carry S.Bus.
FileSource readFile(const FileName &name, const line::Overrules &overrules = {});

}  // namespace tool
