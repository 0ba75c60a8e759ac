#include "SentFile.h"

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace host {

namespace {

// So a frame has a line of its own even if the next one follows at once, and no line is too long for parseRecording().
constexpr unsigned LineMax = sbus::FrameSize;

}  // namespace

SentFile::SentFile(const std::string &name) : _name(name), _file(name, std::ios::binary) {
  if (!_file) {
    throw std::runtime_error(name + ": cannot be written (" + std::strerror(errno) + "); name another file for --sent");
  }
}

void SentFile::opened(const PortSettings &settings) {
  if (settings == _settings) {
    return;
  }
  endLine();
  _settings = settings;
  _characterUs = settings.characterUs();
  _file << "# " << text(wireFrom(settings)) << '\n';
}

void SentFile::look(const Character &character) {
  if (_onLine == LineMax || character.endUs != _lastEndUs + _characterUs) {
    endLine();
  }
  if (_onLine == 0) {
    _file << character.endUs;
  }
  constexpr char Digits[] = "0123456789ABCDEF";
  _file << ' ' << Digits[character.value >> 4] << Digits[character.value & 0xF];
  _lastEndUs = character.endUs;
  _onLine++;
}

std::string SentFile::finish() {
  endLine();
  _file.close();
  return _file ? "" : _name + ": could not be written to its end; is there place for it?";
}

void SentFile::endLine() {
  if (_onLine != 0) {
    _file << '\n';
    _onLine = 0;
  }
}

}  // namespace host
