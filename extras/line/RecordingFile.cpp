#include "RecordingFile.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "CsvRows.h"

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

unsigned long recordedBaud(const std::string &name) {
  std::ifstream in(name, std::ios::binary);
  for (std::string line; std::getline(in, line) && line.rfind("#", 0) == 0;) {
    const size_t end = line.find(" baud");
    if (end != std::string::npos && line.find_first_not_of("0123456789", 2) == end) {
      return std::strtoul(line.c_str() + 2, nullptr, 10);
    }
  }
  return 0;
}

bool isCsv(const std::string &name) {
  constexpr int Enough = 4096;  // bytes: two rows and more
  std::ifstream in(name, std::ios::binary);
  CsvRows rows;
  for (int i = 0; i < Enough && !rows.recognised(); i++) {
    const int byte = in.get();
    if (byte == std::ifstream::traits_type::eof()) {
      break;
    }
    rows.put(static_cast<uint8_t>(byte));
  }
  return rows.recognised();
}

LineSettings csvSettings() {
  LineSettings settings;
  settings.baud = 115200;
  settings.format = {8, Parity::None, 1};
  settings.polarity = Polarity::Either;
  return settings;
}

Recording readCsv(const std::string &name) {
  constexpr uint64_t RowUs = 200000;
  std::ifstream in(name, std::ios::binary);
  Recording recording;
  uint64_t us = 0;
  for (std::string row; std::getline(in, row);) {
    us += RowUs;
    Character character;
    character.endUs = us;
    for (const char c : row.substr(0, RecordingLineMax / 2) + '\n') {
      character.value = static_cast<uint8_t>(c);
      recording.characters.push_back(character);
      character.endUs += csvSettings().characterUs();
    }
  }
  if (in.bad() || recording.characters.empty()) {
    throw std::runtime_error(name + ": cannot be read");
  }
  return recording;
}

LineFile::LineFile(const std::string &name, bool isNew) : _name(name) {
  struct stat status;
  if (isNew && stat(name.c_str(), &status) == 0 && S_ISREG(status.st_mode) && status.st_size > 0) {
    throw std::runtime_error(name + ": is there already; name another file, or remove it");
  }
  _file = open(name.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
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

// A full disk takes a part of a line: that part goes.
void LineFile::fail() {
  _failure = _name + ": could not be written to its end (" + std::strerror(errno) + ")";
  if (ftruncate(_file, _size) == 0) {
    _failure += "; what came before is whole";
  }
  _failure += "; is there place for it?";
}

std::string LineFile::finish() {
  const int file = std::exchange(_file, -1);
  if (file >= 0 && close(file) != 0 && _failure.empty()) {
    _failure = _name + ": could not be written to its end (" + std::strerror(errno) + "); is there place for it?";
  }
  return _failure;
}

}  // namespace line
