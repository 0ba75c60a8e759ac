// Recordings in files.
#pragma once

#include <fstream>
#include <string>

#include "Recording.h"
#include "RecordingWriter.h"

namespace line {

// Throws std::runtime_error, which names file and line, if it cannot be read or something is wrong with it.
Recording readRecording(const std::string &name, uint32_t characterUs = CharacterUs);

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
