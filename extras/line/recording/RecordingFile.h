// Reads and writes recordings in files.
#pragma once

#include <string>

#include "line/recording/Recording.h"
#include "line/recording/RecordingWriter.h"

namespace line {

// Reads a recording. If it is wrong or cannot be read, throws std::runtime_error with file and line.
Recording readRecording(const std::string &name, uint32_t characterUs = CharacterUs);

// A text file that grows line by line. It has only whole lines, even if the program is killed or the disk is full.
class LineFile {
 public:
  // Opens the file. Throws std::runtime_error if it cannot be written; with `isNew` also if it exists and is not empty.
  explicit LineFile(const std::string &name, bool isNew = false);
  ~LineFile();
  LineFile(const LineFile &) = delete;
  LineFile &operator=(const LineFile &) = delete;

  // Writes whole lines; nothing more after an error.
  void write(const std::string &lines);

  // Waits until the disk itself has the lines, and the folder the file: they survive a power cut.
  void sync();

  // Closes the file. Returns the error, if any.
  std::string finish();

  const std::string &failure() const { return _failure; }

  // Returns true if no whole line was written.
  bool isEmpty() const { return _size == 0; }

 private:
  void fail();
  std::string incomplete(int error, const char *what) const;

  std::string _name;
  int _file;
  bool _isSynced = false;  // the folder has the file
  long _size = 0;          // of the whole lines
  std::string _failure;
};

// Writes a recording to a file.
class RecordingFile {
 public:
  explicit RecordingFile(const std::string &name) : _file(name) {}  // throws std::runtime_error

  void opened(const LineSettings &settings) { _writer.opened(settings); }
  void put(const Character &character) {
    _writer.put(character);
    _file.write(_writer.take());
  }

  // Ends the last line and closes the file. Returns the error, if any.
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
