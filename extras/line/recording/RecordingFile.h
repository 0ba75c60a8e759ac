// Recordings in files.
#pragma once

#include <string>

#include "line/recording/Recording.h"
#include "line/recording/RecordingWriter.h"

namespace line {

// Throws std::runtime_error, which names file and line, if it cannot be read or something is wrong with it.
Recording readRecording(const std::string &name, uint32_t characterUs = CharacterUs);

// The first bytes of a file, `size` at most; none if it cannot be read.
std::string beginningOf(const std::string &name, size_t size);

// How its line was set: see settingsIn().
LineSettings recordedSettings(const std::string &name);

// Reads the rows that a sketch prints, as the line of its Serial: see RecordingReader. Throws as readRecording().
Recording readCsv(const std::string &name);

// A text file that grows line by line. Whatever happens it holds whole lines: if the program is killed, or the disk
// full.
class LineFile {
 public:
  // Throws std::runtime_error. `isNew`: a file that is there and has something in it is left alone, and that is an
  // error.
  explicit LineFile(const std::string &name, bool isNew = false);
  ~LineFile();
  LineFile(const LineFile &) = delete;
  LineFile &operator=(const LineFile &) = delete;

  // Whole lines. Once something has gone wrong nothing more is written.
  void write(const std::string &lines);

  // Closes the file. Returns what has gone wrong, or nothing.
  std::string finish();

  const std::string &failure() const { return _failure; }

 private:
  void fail();

  std::string _name;
  int _file;
  long _size = 0;  // of the whole lines
  std::string _failure;
};

// A recording that is written.
class RecordingFile {
 public:
  explicit RecordingFile(const std::string &name) : _file(name) {}  // throws std::runtime_error

  void opened(const LineSettings &settings) { _writer.opened(settings); }
  void put(const Character &character) {
    _writer.put(character);
    _file.write(_writer.take());
  }

  // Ends the last line and closes the file. Returns what has gone wrong, or nothing.
  std::string finish() {
    _writer.finish();
    _file.write(_writer.take());
    return _file.finish();
  }

 private:
  LineFile _file;
  RecordingWriter _writer;
};

}  // namespace line
