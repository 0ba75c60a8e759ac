#include "cli/FileSource.h"

#include <cstdio>
#include <stdexcept>

#include "cli/options/Subcommand.h"
#include "line/file/CaptureFile.h"
#include "line/capture/PackedFile.h"
#include "line/capture/RecordedCapture.h"

namespace tool {

namespace {

// Prints to standard error which signal was chosen, if others carry S.Bus as well, and which part is decoded, if not
// all.
void reportSignal(const std::string &name, const line::WireDecoder &wire) {
  if (!wire.note().empty()) {
    std::fprintf(stderr, "%s: %s\n", name.c_str(), wire.note().c_str());
  }
  if (!wire.others().empty()) {
    std::string others;
    for (const std::string &other : wire.others()) {
      others += (others.empty() ? "" : ", ") + other;
    }
    std::fprintf(stderr, "%s: this is signal %s; S.Bus is also on %s: --signal NAME chooses\n", name.c_str(),
                 wire.signal().c_str(), others.c_str());
  }
}

void readCapture(FileSource &file, const FileName &name, const line::Overrides &overrides) {
  line::RecordedCapture capture(overrides, false);
  const std::string failure =
      capture.failure(name.shown, line::readCapture(name.path, name.shown, overrides, capture.wire()));
  if (!failure.empty()) {
    throw std::runtime_error(failure);
  }
  reportSignal(name.shown, capture.wire());
  file.settings = capture.settings();
  file.signal = capture.wire().signal();
  file.recording = std::move(capture.recording);
  file.zeroUs = file.recording.zeroUs;
}

}  // namespace

FileSource readHead(const FileName &name, unsigned long baud) {
  line::PackedFile file(name.path, name.shown);
  FileSource source;
  source.path = name.path;
  if (file.isSession()) {
    source.kind = line::FileKind::Capture;
    return source;
  }
  std::string begin = file.begin();
  const std::string own = line::exportOf(begin, name.shown);
  if (own.empty() || begin.substr(0, 2) != "PK") {
    file.findOnly();
    begin.clear();
    for (std::string_view read = file.read(); !read.empty() && begin.size() < line::FileHeadMax; read = file.read()) {
      begin += read;
    }
    begin.resize(std::min(begin.size(), line::FileHeadMax));
  }
  if (begin.empty()) {
    file.requireEnd();
  }
  static_cast<line::FileHead &>(source) = line::readFileHead(begin, file.unpackedName(), baud);
  if (source.kind == line::FileKind::Wrong) {
    throw std::runtime_error(name.shown + ": " + source.error);
  }
  return source;
}

FileSource readFile(const FileName &name, const line::Overrides &overrides) {
  FileSource file = readHead(name, overrides.baud);
  if (file.isCapture()) {
    readCapture(file, name, overrides);
  } else if (!overrides.signal.empty()) {
    rejectCommandLine("--signal: is for a capture of several signals; leave it out for " + name.shown);
  }
  if (!file.note.empty()) {
    std::fprintf(stderr, "%s: %s\n", name.shown.c_str(), file.note.c_str());
  }
  return file;
}

}  // namespace tool
