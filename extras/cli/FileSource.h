// Opens a file of any kind: line::FileHead decides what it is.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "line/capture/Capture.h"
#include "line/capture/WireDecoder.h"
#include "line/file/FileHead.h"
#include "line/recording/Recording.h"

namespace tool {

// A file's path, and its name in messages.
struct FileName {
  FileName(const std::string &name) : path(name), shown(name) {}  // implicit: most files have one name
  FileName(std::string where, std::string name) : path(std::move(where)), shown(std::move(name)) {}

  std::string path;
  std::string shown;
};

struct FileSource : line::FileHead {
  std::string path;           // of a text and of bytes, which are read while they are played
  std::string signal;         // a capture's
  line::Recording recording;  // a capture's

  bool isCapture() const { return kind == line::FileKind::Capture; }
  bool isRows() const { return kind == line::FileKind::Rows; }
  bool areBytes() const { return kind == line::FileKind::Bytes || kind == line::FileKind::Text; }
};

// Examines the beginning of a file, packed or not: see line::PackedFile. Throws std::runtime_error if it cannot be read
// or is of no known kind.
FileSource readHead(const FileName &name, unsigned long baud = 0);

// Reads a capture, or the head of another file. `overrides`: what the user knows better than the file. Throws
// std::runtime_error with the place if it is wrong. Prints to standard error what a user should know of it.
FileSource readFile(const FileName &name, const line::Overrides &overrides = {});

}  // namespace tool
