// A source that may be a pipe: standard input, or a FIFO. What comes may be a live line, or a file of any kind.
#pragma once

#include <optional>
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

  // What a pipe brings: the bytes of a line, or the rows of a sketch; a text that can be played while it is being
  // written; or a file of another kind, which has to be read to its end first.
  enum class Content { Line, Text, File };

  // Waits for the first bytes, for `seconds` at most; 0: until Ctrl-C. A pipe in which nothing comes is a line.
  Content content(double seconds);

  // Returns the file, of a pipe a copy of all that comes. Throws std::runtime_error.
  FileName wholeFile();

  // Returns true if it has ended without a byte.
  bool isEmpty() const { return _begin.empty() && _ended; }

  // Returns true if the live line brings the rows of a sketch.
  bool hasRows() const { return _hasRows; }

  // Returns the kind of the text.
  FileKind textKind() const { return *_textKind; }

  // Both are of a live line, or a text: its descriptor, and the bytes that have been read from it.
  int descriptor() const { return _file; }
  const std::string &begin() const { return _begin; }

 private:
  bool readMore(int ms);

  const std::string _name;
  int _file = -1;  // of a pipe
  std::string _begin;
  bool _ended = false;
  bool _hasRows = false;
  std::optional<FileKind> _textKind;
  int _copy = -1;
};

}  // namespace tool
