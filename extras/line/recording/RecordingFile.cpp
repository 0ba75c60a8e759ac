#include "line/recording/RecordingFile.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "line/recording/RecordingReader.h"
#include "line/system/System.h"

namespace line {

Recording readRecording(const std::string &name, uint32_t characterUs) {
  std::error_code unknown;
  if (std::filesystem::is_directory(name, unknown)) {  // otherwise the stream throws when it is read
    throw std::runtime_error(name + ": is a folder; the name of a recording is expected");
  }
  std::ifstream in(name, std::ios::binary);
  if (!in) {
    throw std::runtime_error(name + ": cannot be opened (" + std::strerror(errno) +
                             "); the name of a recording is expected");
  }
  const std::string text(std::istreambuf_iterator<char>(in), {});
  if (in.bad()) {
    throw std::runtime_error(name + ": cannot be read");
  }
  Recording recording = parseRecording(text, characterUs);
  if (!recording.error.empty()) {
    const std::string place = recording.errorLine > 0 ? ":" + std::to_string(recording.errorLine) : "";
    throw std::runtime_error(name + place + ": " + recording.error);
  }
  return recording;
}

LineFile::LineFile(const std::string &name, bool isNew) : _name(name) {
  struct stat status;
  if (isNew && stat(name.c_str(), &status) == 0 && S_ISREG(status.st_mode) && status.st_size > 0) {
    throw std::runtime_error(name + ": already exists; name another file, or remove it");
  }
  _file = open(name.c_str(), O_WRONLY | O_CREAT | O_TRUNC | CloseOnExec, 0666);
  if (_file < 0) {
    throw std::runtime_error(name + ": cannot be written (" + std::strerror(errno) + "); name another file");
  }
}

LineFile::~LineFile() {
  if (_file >= 0) {
    close(_file);
  }
}

void LineFile::write(const std::string &lines) {
  for (size_t at = 0; at < lines.size() && _failure.empty();) {
    const ssize_t count = ::write(_file, lines.data() + at, lines.size() - at);
    if (count > 0) {
      at += static_cast<size_t>(count);
    } else if (count == 0 || errno != EINTR) {
      fail();
    }
  }
  _size += _failure.empty() ? static_cast<long>(lines.size()) : 0;
}

void LineFile::sync() {
  if (_failure.empty() && !syncFile(_file)) {
    fail();
  }
  if (!std::exchange(_isSynced, true)) {
    syncFolder(std::filesystem::path(_name).parent_path().string());
  }
}

// A full disk takes only part of a line; removes that part, and a file without a line.
void LineFile::fail() {
  const int error = errno;
  struct stat status;
  const bool isCut = ftruncate(_file, _size) == 0;
  if (isCut && _size == 0 && stat(_name.c_str(), &status) == 0 && S_ISREG(status.st_mode)) {
    std::remove(_name.c_str());
  }
  _failure = incomplete(error, isCut && _size > 0 ? "; what was written before is valid" : "");
}

std::string LineFile::incomplete(int error, const char *what) const {
  const bool isFull = error == ENOSPC || error == EFBIG;
  return _name + ": could not be written completely (" + std::strerror(error) + ")" + what +
         (isFull ? "; is the disk full?" : "; check the disk, or write elsewhere");
}

std::string LineFile::finish() {
  const int file = std::exchange(_file, -1);
  if (file >= 0 && close(file) != 0 && _failure.empty()) {
    _failure = incomplete(errno, "");
  }
  return _failure;
}

}  // namespace line
