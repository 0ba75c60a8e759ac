#include "line/capture/PackedFile.h"

#include <archive.h>
#include <archive_entry.h>
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace line {

namespace {

constexpr size_t ReadSize = 65536;

}  // namespace

PackedFile::PackedFile(const std::string &name)
    : _file(name == "-" ? STDIN_FILENO : ::open(name.c_str(), O_RDONLY)), _archive(nullptr, archive_read_free) {
  if (_file < 0) {
    throw std::runtime_error(name + ": cannot be opened (" + std::strerror(errno) +
                             "); the name of a capture is expected");
  }
  open();
}

PackedFile::~PackedFile() {
  _archive.reset();
  if (_file != STDIN_FILENO) {
    close(_file);
  }
}

void PackedFile::open() {
  _failure.clear();
  _archive.reset(archive_read_new());
  archive_read_support_filter_gzip(_archive.get());
  archive_read_support_format_zip(_archive.get());
  archive_read_support_format_raw(_archive.get());
  archive_read_support_format_empty(_archive.get());
  _atEnd = !works(archive_read_open_fd(_archive.get(), _file, ReadSize));
  next();
}

bool PackedFile::works(int status) {
  const bool failed = status < ARCHIVE_WARN;
  if (failed) {
    const char *why = archive_error_string(_archive.get());
    _failure = std::string("cannot be read to its end (") + (why == nullptr ? "no reason given" : why) + ")";
  }
  return !failed && status != ARCHIVE_EOF;
}

bool PackedFile::next() {
  archive_entry *entry = nullptr;
  _atEnd = _atEnd || !works(archive_read_next_header(_archive.get(), &entry));
  const char *name = _atEnd ? nullptr : archive_entry_pathname(entry);
  _entry = name == nullptr ? "" : name;
  return !_atEnd;
}

bool PackedFile::isZip() const {
  return (archive_format(_archive.get()) & ARCHIVE_FORMAT_BASE_MASK) == ARCHIVE_FORMAT_ZIP;
}

bool PackedFile::canGoBack() const {
  return lseek(_file, 0, SEEK_CUR) >= 0;
}

bool PackedFile::find(const std::string &entry) {
  while (!_atEnd && _entry != entry) {
    next();
  }
  if (_atEnd && lseek(_file, 0, SEEK_SET) == 0) {
    open();
    while (!_atEnd && _entry != entry) {
      next();
    }
  }
  return !_atEnd;
}

std::string_view PackedFile::read() {
  const void *bytes = nullptr;
  size_t count = 0;
  la_int64_t at = 0;
  int status = _atEnd ? ARCHIVE_EOF : ARCHIVE_OK;
  while (status >= ARCHIVE_WARN && status != ARCHIVE_EOF && count == 0) {
    status = archive_read_data_block(_archive.get(), &bytes, &count, &at);
  }
  return works(status) ? std::string_view(static_cast<const char *>(bytes), count) : std::string_view();
}

}  // namespace line
