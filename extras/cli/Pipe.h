// A source that may be a pipe: standard input, or a FIFO. What comes may be a live line, or a file of any kind.
#pragma once

#include <string>

#include "cli/FileSource.h"

namespace tool {

class Pipe {
 public:
  // `name` is a file, a FIFO, or "-" for standard input. Throws std::runtime_error if a FIFO cannot be opened.
  explicit Pipe(std::string name);
  ~Pipe();
  Pipe(const Pipe &) = delete;
  Pipe &operator=(const Pipe &) = delete;

  // Returns true for standard input and for a FIFO.
  static bool isPipe(const std::string &name);

  // Waits for the first bytes, for `seconds` at most; 0: until Ctrl-C. Returns true if they are a line's, or the rows
  // of a sketch; false if they are a file: packed, a capture, or another text. A pipe in which nothing comes is a line.
  bool isLive(double seconds);

  // Returns the file, of a pipe a copy of all that comes. Throws std::runtime_error.
  FileName wholeFile();

  // Returns true if the live line brings the rows of a sketch.
  bool hasRows() const { return _hasRows; }

  // Both are of a live line: its descriptor, and the bytes that have been read from it.
  int descriptor() const { return _file; }
  const std::string &begin() const { return _begin; }

 private:
  bool readMore(int ms);

  const std::string _name;
  int _file = -1;  // of a pipe
  std::string _begin;
  bool _ended = false;
  bool _hasRows = false;
  int _copy = -1;
};

}  // namespace tool
