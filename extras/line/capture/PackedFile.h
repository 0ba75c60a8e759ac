// Reads a file's bytes. It unpacks a .gz, and a ZIP, one entry after the other.
#pragma once

#include <memory>
#include <string>
#include <string_view>

struct archive;

namespace line {

class PackedFile {
 public:
  // `name` is a file, or "-" for standard input. Throws std::runtime_error if it cannot be opened.
  explicit PackedFile(const std::string &name);
  ~PackedFile();
  PackedFile(const PackedFile &) = delete;
  PackedFile &operator=(const PackedFile &) = delete;

  bool isZip() const;

  // Returns false for a pipe.
  bool canGoBack() const;

  // Goes to the beginning of a ZIP's entry, wherever it stands in the file. Returns false if no entry has this name.
  bool find(const std::string &entry);

  // Waits for a byte or more. Returns what has come; nothing at the end, and after a failure.
  std::string_view read();

  // Returns why the file could not be read to its end; nothing if it could.
  const std::string &failure() const { return _failure; }

 private:
  void open();
  bool next();
  bool works(int status);

  const int _file;
  std::unique_ptr<archive, int (*)(archive *)> _archive;
  std::string _entry;  // name of the entry
  bool _atEnd = false;
  std::string _failure;
};

}  // namespace line
