// Reads a file's bytes. It unpacks gzip, xz, and a ZIP entry by entry.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "line/recording/PlainText.h"

struct archive;

namespace line {

// Returns true if the bytes are the beginning of a packed file: gzip, xz or ZIP.
bool isPacked(std::string_view begin);

// Returns true if a file that begins with `begin` may be packed; `begin` may be too short to tell.
bool mayBePacked(std::string_view begin);

// Copies `begin` and then the rest of `file`, for a pipe until `isOver` returns true, to a file without a name, which
// vanishes when it is closed. Returns that file, rewound. Throws std::runtime_error if the disk is full.
int copyToTemporary(std::string_view begin, int file, bool (*isOver)());

class PackedFile {
 public:
  // `path` is a file, or "-" for standard input; messages call it `name`. Throws std::runtime_error if it cannot be
  // opened.
  PackedFile(const std::string &path, std::string name);
  ~PackedFile();
  PackedFile(const PackedFile &) = delete;
  PackedFile &operator=(const PackedFile &) = delete;

  // Returns true for a session of sigrok or PulseView: a ZIP with the entry "metadata".
  bool isSession();

  // Goes to the beginning of a ZIP's entry, wherever it is in the file. Returns false if no entry has this name.
  bool find(const std::string &entry);

  // Returns the first 64 bytes as they are in the file; nothing of a pipe.
  std::string begin() const;

  // Goes to the only file in a ZIP that is not hidden; leaves other files as they are. Throws std::runtime_error if the
  // ZIP holds several.
  void findOnly();

  // Returns the name of the packed file: without .gz or .xz, or the ZIP's entry.
  std::string unpackedName() const;

  // Waits for at least one byte. Returns those received; nothing at the end and after a failure.
  std::string_view read();

  // Returns why the file could not be read to its end; otherwise nothing.
  const std::string &failure() const { return _failure; }

  // Throws std::runtime_error with name and reason if the file could not be read to its end.
  void requireEnd() const;

 private:
  void open();
  bool next();
  bool works(int status);
  static std::ptrdiff_t fill(archive *, void *self, const void **bytes);

  const std::string _name;
  int _file;
  std::string _begin;  // a pipe's first bytes
  std::string _block;
  bool _isPipe = false;
  bool _isZip = false;
  std::unique_ptr<archive, int (*)(archive *)> _archive;
  std::string _entry;  // its name
  bool _atEnd = false;
  std::string _failure;
};

// Reads the text of a file, packed or not.
class TextFile {
 public:
  // Reads the rest of `file`.
  explicit TextFile(PackedFile &file) : _file(file) {}

  // Waits for at least one character. Returns those received; nothing at the end and after a failure.
  std::string_view read() {
    std::string_view text;
    while (!_atEnd && text.empty()) {
      const std::string_view bytes = _file.read();
      _atEnd = bytes.empty();
      text = _atEnd ? _plain.finish() : _plain.put(bytes);
    }
    return text;
  }

 private:
  PackedFile &_file;
  PlainText _plain;
  bool _atEnd = false;
};

}  // namespace line
