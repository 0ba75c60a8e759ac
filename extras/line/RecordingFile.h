// Recordings in files.
#pragma once

#include <fstream>
#include <string>

#include "Recording.h"
#include "RecordingWriter.h"

namespace line {

// Throws std::runtime_error, which names file and line, if it cannot be read or something is wrong with it.
Recording readRecording(const std::string &name, uint32_t characterUs = CharacterUs);

// True if the file begins with the rows that a sketch prints.
bool isCsv(const std::string &name);

// Such a file as the line of a sketch's Serial, 115200 baud, 8N1: a row every 200 ms, as the examples print them. Throws as
// readRecording().
Recording readCsv(const std::string &name);

// One that is written.
class RecordingFile {
 public:
  explicit RecordingFile(const std::string &name);  // throws std::runtime_error

  void opened(const LineSettings &settings) { _writer.opened(settings); }
  void put(const Character &character) { _writer.put(character); }

  // Ends the last line and closes the file. Returns what has gone wrong, or nothing.
  std::string finish();

 private:
  std::string _name;
  std::ofstream _file;
  RecordingWriter _writer{_file};
};

}  // namespace line
