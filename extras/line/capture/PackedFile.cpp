#include "line/capture/PackedFile.h"

#include <archive.h>
#include <archive_entry.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "line/recording/Words.h"
#include "line/system/System.h"

namespace line {

namespace {

constexpr size_t ReadSize = 65536;

// The first bytes of packed files. The fourth byte of gzip holds flags, below 20.
constexpr std::string_view Gzip("\x1F\x8B\x08", 3);
constexpr std::string_view Xz(
    "\xFD"
    "7zXZ\0",
    6);
constexpr std::string_view Zip("PK\x03\x04", 4);
constexpr std::string_view EmptyZip("PK\x05\x06", 4);

bool begins(std::string_view text, std::string_view with) { return text.substr(0, with.size()) == with; }

// Reads `size` bytes, or up to the end of the file.
std::string readSome(int file, size_t size) {
  std::string bytes(size, '\0');
  size_t have = 0;
  while (have < size) {
    const ssize_t count = ::read(file, &bytes[have], size - have);
    if (count == 0 || (count < 0 && errno != EINTR)) {
      break;
    }
    have += count > 0 ? static_cast<size_t>(count) : 0;
  }
  bytes.resize(have);
  return bytes;
}

// Opens a file. /dev/stdin and /dev/fd/N are rewound to the beginning, on every system.
int openToRead(const std::string &path) {
  const std::string folder = "/dev/fd/";
  const int known = path == "/dev/stdin"         ? STDIN_FILENO
                    : path.rfind(folder, 0) == 0 ? std::atoi(&path[folder.size()])
                                                 : -1;
  if (known < 0) {
    return ::open(path.c_str(), O_RDONLY | CloseOnExec);
  }
  const int file = dup(known);
  lseek(file, 0, SEEK_SET);
  return file;
}

// Removes `end` from the end of the name. Returns true if it was there.
bool cutEnd(std::string &name, std::string_view end) {
  const bool has = name.size() > end.size() && lower(name).compare(name.size() - end.size(), end.size(), end) == 0;
  name.resize(name.size() - (has ? end.size() : 0));
  return has;
}

}  // namespace

bool isPacked(std::string_view begin) {
  const bool isGzip =
      begins(begin, Gzip) && begin.size() > Gzip.size() && begin[Gzip.size()] >= 0 && begin[Gzip.size()] < 0x20;
  return isGzip || begins(begin, Xz) || begins(begin, Zip) || begins(begin, EmptyZip);
}

bool mayBePacked(std::string_view begin) {
  return isPacked(begin) || begins(Gzip, begin) || begins(Xz, begin) || begins(Zip, begin) || begins(EmptyZip, begin);
}

int copyToTemporary(std::string_view begin, int file, bool (*isOver)()) {
  constexpr int LookMs = 50;
  const int copy = openTemporary();
  bool works = copy >= 0;
  std::string bytes(begin);
  for (bool isAtEnd = false; works && !isAtEnd;) {
    for (size_t at = 0; at < bytes.size() && works;) {
      const ssize_t count = ::write(copy, bytes.data() + at, bytes.size() - at);
      works = count > 0 || (count < 0 && errno == EINTR);
      at += count > 0 ? static_cast<size_t>(count) : 0;
    }
    bytes.assign(ReadSize, '\0');
    const bool isThere = isReadable(file, LookMs);
    const ssize_t count = isThere ? ::read(file, &bytes[0], bytes.size()) : 0;
    bytes.resize(count > 0 ? static_cast<size_t>(count) : 0);
    isAtEnd = isOver() || (isThere && count == 0) || (count < 0 && errno != EINTR);
  }
  if (!works || lseek(copy, 0, SEEK_SET) != 0) {
    throw std::runtime_error(std::string("a pipe cannot be kept in a temporary file (") + std::strerror(errno) +
                             "): save it in a file first");
  }
  return copy;
}

PackedFile::PackedFile(const std::string &path, std::string name)
    : _name(std::move(name)),
      _file(path == "-" ? STDIN_FILENO : openToRead(path)),
      _archive(nullptr, archive_read_free) {
  if (_file < 0) {
    throw std::runtime_error(_name + ": cannot be opened (" + std::strerror(errno) +
                             "); the name of a recording is expected");
  }
  struct stat status;
  _isPipe = fstat(_file, &status) != 0 || !S_ISREG(status.st_mode);
  if (_isPipe) {
    _begin = readSome(_file, Zip.size());
    if (begins(_begin, Zip)) {  // its entries can be read in any order
      const int copy = copyToTemporary(_begin, _file, [] { return false; });
      if (_file != STDIN_FILENO) {
        close(_file);
      }
      _file = copy;
      _isPipe = false;
    }
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
  archive_read_support_filter_xz(_archive.get());
  archive_read_support_format_zip(_archive.get());
  archive_read_support_format_raw(_archive.get());
  archive_read_support_format_empty(_archive.get());
  _atEnd = !works(_isPipe ? archive_read_open(_archive.get(), this, nullptr, fill, nullptr)
                          : archive_read_open_fd(_archive.get(), _file, ReadSize));
  next();
  _isZip = (archive_format(_archive.get()) & ARCHIVE_FORMAT_BASE_MASK) == ARCHIVE_FORMAT_ZIP;
}

// Reads from a pipe without waiting for a full buffer.
std::ptrdiff_t PackedFile::fill(archive *, void *self, const void **bytes) {
  PackedFile &file = *static_cast<PackedFile *>(self);
  if (!file._begin.empty()) {
    file._block = std::exchange(file._begin, "");
    *bytes = file._block.data();
    return static_cast<std::ptrdiff_t>(file._block.size());
  }
  file._block.resize(ReadSize);
  *bytes = file._block.data();
  ssize_t count;
  do {
    count = ::read(file._file, &file._block[0], ReadSize);
  } while (count < 0 && errno == EINTR);
  if (count < 0) {
    archive_set_error(file._archive.get(), errno, "%s", std::strerror(errno));
  }
  return count;
}

bool PackedFile::works(int status) {
  const bool failed = status < ARCHIVE_WARN;
  if (failed) {
    const char *why = archive_error_string(_archive.get());
    const int error = archive_errno(_archive.get());
    _failure = std::string("cannot be read to its end (") +
               (error == EIO     ? std::strerror(error)
                : why == nullptr ? "no reason given"
                                 : why) +
               ")";
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

bool PackedFile::isSession() { return _isZip && find("metadata"); }

bool PackedFile::find(const std::string &entry) {
  while (!_atEnd && _entry != entry) {
    next();
  }
  if (_atEnd && !_isPipe && lseek(_file, 0, SEEK_SET) == 0) {
    open();
    while (!_atEnd && _entry != entry) {
      next();
    }
  }
  return !_atEnd;
}

std::string PackedFile::begin() const {
  constexpr size_t Size = 64;
  const auto at = _isPipe ? -1 : lseek(_file, 0, SEEK_CUR);
  if (at < 0 || lseek(_file, 0, SEEK_SET) != 0) {
    return {};
  }
  const std::string begin = readSome(_file, Size);
  lseek(_file, at, SEEK_SET);  // libarchive goes on there
  return begin;
}

void PackedFile::findOnly() {
  if (!_isZip) {
    return;
  }
  std::string only;
  lseek(_file, 0, SEEK_SET);
  open();
  for (; !_atEnd; next()) {
    // macOS adds __MACOSX/._NAME to each file, and .DS_Store to each folder.
    const std::string name = _entry.substr(_entry.rfind('/') + 1);
    if (name.empty() || name.front() == '.') {
      continue;
    }
    if (!only.empty()) {
      throw std::runtime_error(
          _name + ": is a ZIP of several files, but not a session of sigrok or PulseView: unpack it, and name one");
    }
    only = _entry;
  }
  if (only.empty() || !find(only)) {
    throw std::runtime_error(_name + ": is a ZIP without a file in it");
  }
}

std::string PackedFile::unpackedName() const {
  if (_isZip) {
    return _entry;
  }
  std::string name = _name;
  cutEnd(name, ".gz") || cutEnd(name, ".xz");
  return name;
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

void PackedFile::requireEnd() const {
  if (!_failure.empty()) {
    throw std::runtime_error(_name + ": " + _failure);
  }
}

}  // namespace line
