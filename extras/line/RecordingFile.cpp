#include "RecordingFile.h"

#include <cerrno>
#include <cstring>
#include <stdexcept>

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

Recording readCsv(const std::string &name) {
  constexpr uint64_t RowUs = 200000;
  constexpr uint64_t CsvCharacterUs = 86;  // 10 bits
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
      character.endUs += CsvCharacterUs;
    }
  }
  if (in.bad() || recording.characters.empty()) {
    throw std::runtime_error(name + ": cannot be read");
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
