#include "Eeprom.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

namespace host {

namespace {

// The size of a write, and the value of an erased byte.
constexpr size_t WordSize = 4;
constexpr uint8_t Erased = 0x00;
constexpr uint64_t WordUs = 3300;  // the approximate time to write a word

std::runtime_error failure(const std::string &file, const char *what) {
  return std::runtime_error(file + ": " + what + " (" + std::strerror(errno) + "); name another file for --eeprom");
}

}  // namespace

Eeprom::Eeprom() : _bytes(Size, Erased) {
}

Eeprom::~Eeprom() {
  if (_handle >= 0) {
    close(_handle);
  }
}

void Eeprom::keepIn(const std::string &file) {
  _file = file;
  _handle = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  struct stat status;
  if (_handle < 0 || fstat(_handle, &status) != 0) {
    throw failure(file, "cannot be opened for reading and writing");
  }
  if (!S_ISREG(status.st_mode)) {
    throw std::runtime_error(file + ": is not a regular file; name another one for --eeprom");
  }
  if (status.st_size == 0) {
    if (pwrite(_handle, _bytes.data(), Size, 0) != static_cast<ssize_t>(Size)) {
      throw failure(file, "cannot be written");
    }
    return;
  }
  if (status.st_size != static_cast<off_t>(Size)) {
    throw std::runtime_error(file + ": has " + std::to_string(status.st_size) + " bytes; an EEPROM's contents, " +
                             std::to_string(Size) + " bytes, are expected, or no file");
  }
  if (pread(_handle, _bytes.data(), Size, 0) != static_cast<ssize_t>(Size)) {
    throw failure(file, "cannot be read");
  }
}

uint8_t Eeprom::read(int address) const {
  return address >= 0 && static_cast<size_t>(address) < Size ? _bytes[static_cast<size_t>(address)] : 0;
}

uint64_t Eeprom::write(int address, const uint8_t *bytes, size_t size) {
  uint64_t us = 0;
  size_t lastWord = SIZE_MAX;
  for (size_t i = 0; i < size; i++) {
    const int64_t at = int64_t{address} + static_cast<int64_t>(i);
    if (at < 0 || at >= static_cast<int64_t>(Size) || _bytes[static_cast<size_t>(at)] == bytes[i]) {
      continue;
    }
    const size_t place = static_cast<size_t>(at);
    _bytes[place] = bytes[i];
    save(place);
    if (place / WordSize != lastWord) {
      lastWord = place / WordSize;
      us += WordUs;
    }
  }
  return us;
}

// Writes to the file at once, so that nothing is lost if the program is killed.
void Eeprom::save(size_t address) {
  if (_handle >= 0 && pwrite(_handle, &_bytes[address], 1, static_cast<off_t>(address)) != 1) {
    std::fprintf(stderr, "%s: cannot be written (%s)\n", _file.c_str(), std::strerror(errno));
    std::_Exit(EXIT_FAILURE);
  }
}

}  // namespace host
