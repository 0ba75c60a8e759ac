#include "RecordingFile.h"

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace line {

Recording readRecording(const std::string &name, uint32_t characterUs) {
  std::ifstream in(name, std::ios::binary);
  if (!in) {
    throw std::runtime_error(name + ": cannot be opened; the name of a recording is expected");
  }
  RecordingReader reader(characterUs);
  for (std::string line; std::getline(in, line);) {
    reader.line(line);
  }
  if (in.bad()) {
    throw std::runtime_error(name + ": cannot be read");
  }
  Recording recording = reader.finish();
  if (!recording.error.empty()) {
    const std::string place = recording.errorLine > 0 ? ":" + std::to_string(recording.errorLine) : "";
    throw std::runtime_error(name + place + ": " + recording.error);
  }
  return recording;
}

RecordingFile::RecordingFile(const std::string &name) : _name(name), _file(name, std::ios::binary) {
  if (!_file) {
    throw std::runtime_error(name + ": cannot be written (" + std::strerror(errno) + "); name another file");
  }
}

std::string RecordingFile::finish() {
  _writer.finish();
  _file.close();
  return _file ? "" : _name + ": could not be written to its end; is there place for it?";
}

}  // namespace line
