#include "cli/FileSource.h"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "cli/HexText.h"
#include "cli/JsonReader.h"
#include "cli/TableReader.h"
#include "line/capture/CaptureFile.h"
#include "line/capture/Parsing.h"
#include "line/capture/RecordedCapture.h"
#include "line/capture/TextFile.h"
#include "line/recording/CsvRows.h"
#include "line/recording/Words.h"

namespace tool {

namespace {

bool hasBytesExtension(const std::string &name) {
  const std::string end = line::lower(name.size() < 4 ? "" : std::string_view(name).substr(name.size() - 4));
  return end == ".bin" || end == ".raw";
}

// Returns the line without a comment.
std::string_view content(std::string_view line) {
  return line::trimmed(line.substr(0, line.find('#')));
}

// Returns true if the text begins with an offset, as a line of `xxd` or `hexdump -C` does.
bool isOffset(std::string_view text) {
  const std::string_view word = text.substr(0, text.find_first_of(" \t"));
  const size_t digits = std::min(word.size(), word.find(':'));
  return digits >= 6 && digits < text.size() &&
         (word.size() > digits || word.find_first_not_of('0') == std::string_view::npos);
}

// Returns true if the text is bytes in hexadecimal, not a recording. A line of a recording begins with a time of one
// digit, or of three or more. Two digits are a time only in a single line, since lines are further apart than that.
bool isHexText(std::string_view head) {
  std::string first[2];
  size_t lines = 0;
  while (!head.empty() && lines < 2) {
    const std::string_view text = content(line::takeLine(head));
    if (lines == 0 && isOffset(text)) {
      return true;
    }
    if (!text.empty()) {
      first[lines++] = text.substr(0, text.find_first_of(" \t"));
    }
  }
  const std::string time = first[0].substr(0, first[0].find('~'));
  const bool maybeTime = time.find_first_not_of("0123456789") == std::string::npos;
  const HexText hex = parseHex(first[0]);
  if (first[0][0] == '-' || !hex.wrong.empty() || hex.bytes.empty()) {
    return false;
  }
  return !maybeTime || (time.size() == 2 && first[1].size() == 2);
}

// Appends bytes to a recording, back to back.
class BackToBack {
 public:
  BackToBack(line::Recording &recording, const line::LineSettings &settings)
      : _recording(recording), _characterUs(settings.characterUs()) {}

  void put(uint8_t value, bool bad) {
    _character.endUs += _characterUs;
    _character.value = value;
    _character.bad = bad;
    _recording.characters.push_back(_character);
  }

 private:
  line::Recording &_recording;
  const uint32_t _characterUs;
  line::Character _character;
};

void readHexLine(std::string_view line, const std::string &place, BackToBack &bytes) {
  const std::string_view text = content(line);
  if (isOffset(text)) {
    throw std::runtime_error(place +
                             "begins with the offset of a dump; leave offsets and text out, or convert it "
                             "to bytes: xxd -r DUMP FILE.bin");
  }
  const HexText hex = parseHex(text);
  if (!hex.wrong.empty()) {
    throw std::runtime_error(place + line::quoted(hex.wrong) +
                             " is not hexadecimal; bytes of two digits are expected, such as 0F E3; # begins a "
                             "comment");
  }
  for (const HexText::Byte &byte : hex.bytes) {
    bytes.put(byte.value, byte.bad);
  }
}

FileSource readBytes(line::PackedFile &file, const std::string &name, bool isText, unsigned long baud) {
  FileSource source;
  source.kind = FileKind::Bytes;
  source.hasTimes = false;
  source.settings.baud = baud > 0 ? baud : sbus::Baud;
  BackToBack bytes(source.recording, source.settings);
  if (isText) {
    size_t number = 0;
    line::forEachLine(
        file, [&](std::string_view line) { readHexLine(line, name + ":" + std::to_string(++number) + ": ", bytes); });
  } else {
    for (std::string_view read = file.read(); !read.empty(); read = file.read()) {
      for (const char byte : read) {
        bytes.put(static_cast<uint8_t>(byte), false);
      }
    }
    file.requireEnd();
  }
  if (source.recording.characters.empty()) {
    throw std::runtime_error(name + ": is empty: bytes of a line are expected");
  }
  std::fprintf(stderr, "%s: bytes without times: times are not known, frames are assumed to be back to back\n",
               name.c_str());
  return source;
}

// Returns what the head of a text says about its line.
FileSource headOf(FileKind kind, const std::string &head, unsigned long baud) {
  FileSource source;
  source.kind = kind;
  if (kind == FileKind::Recording) {
    const std::string_view beginning = std::string_view(head).substr(0, line::RecordingBeginning);
    source.settings = line::settingsIn(beginning);
    source.startUs = line::startIn(beginning);
    source.isLate = head.find('~') != std::string::npos;
  } else if (kind == FileKind::Rows) {
    source.settings = line::csvSettings();
    source.hasRowTimes = line::hasTimeColumn(line::withoutMark(head));
  } else if (kind == FileKind::Json) {
    const JsonHead read = readJsonHead(head);
    source.settings = read.settings;
    source.startUs = read.startUs;
    source.hasTimes = read.hasTimes;
    source.isRead = read.isRead;
  }
  if (kind != FileKind::Rows && baud > 0) {
    source.settings = line::LineSettings();
    source.settings.baud = baud;
  }
  return source;
}

class RecordingLines : public LineReader {
 public:
  RecordingLines(uint32_t characterUs, bool isCsv) : _reader(characterUs, isCsv) {}

  std::string line(std::string_view text, std::deque<line::Character> &characters) override {
    _reader.line(text);
    for (const line::Character character : _reader.take()) {
      characters.push_back(character);
    }
    return _reader.error();
  }
  // Like a port, leaves out a row without its end.
  std::string cutLine(std::string_view text, std::deque<line::Character> &characters) override {
    return _reader.isCsv() ? "" : line(text, characters);
  }
  std::string finish() override {
    _hasEnded = true;
    return _reader.finish().error;
  }
  std::string news() override {
    return _hasEnded && _reader.nuls() > 0 ? std::to_string(_reader.nuls()) +
                                                 " NULs were left out, and the lines that they cut: did the power fail?"
                                           : "";
  }

 private:
  bool _hasEnded = false;
  line::RecordingReader _reader;
};

FileSource readCapture(const FileName &name, const line::Overrides &overrides) {
  line::RecordedCapture capture(overrides);
  const std::string failure =
      capture.failure(name.shown, line::readCapture(name.path, name.shown, overrides, capture.wire()));
  if (!failure.empty()) {
    throw std::runtime_error(failure);
  }
  reportSignal(name.shown, capture.wire());
  FileSource file;
  file.kind = FileKind::Capture;
  file.settings = capture.settings();
  file.signal = capture.wire().signal();
  file.recording = std::move(capture.recording);
  return file;
}

constexpr std::string_view RecordedBy = "# sbus ";  // the beginning of a recording made by sbus

bool isControl(char c) {
  return c >= '\0' && c < ' ' && c != '\t' && c != '\n' && c != '\r';
}

}  // namespace

void reportSignal(const std::string &name, const line::WireDecoder &wire) {
  if (!wire.others().empty()) {
    std::string others;
    for (const std::string &other : wire.others()) {
      others += (others.empty() ? "" : ", ") + other;
    }
    std::fprintf(stderr, "%s: this is signal %s; S.Bus is also on %s: --signal NAME chooses\n", name.c_str(),
                 wire.signal().c_str(), others.c_str());
  }
}

// If a sketch's rows look like an oscilloscope's columns, they count as rows.
FileKind kindOfText(const std::string &head, const std::string &name) {
  if (line::withoutBlanks(line::withoutMark(head)).substr(0, 1) == "{") {
    return FileKind::Json;
  }
  if (frameTable(head) == FrameTable::Yes) {
    return FileKind::Table;
  }
  if (line::hasTimeColumn(line::withoutMark(head))) {
    return FileKind::Rows;
  }
  const std::string format = line::captureFormat(head);
  const bool rows = line::isCsvText(std::string_view(head).substr(0, line::RecordingBeginning));
  if (!format.empty() && !(format == line::OscilloscopeFormat && rows)) {
    return FileKind::Capture;
  }
  if (head.rfind("<SALEAE>", 0) == 0) {
    throw std::runtime_error(name + ": is Logic 2's binary export: export it as CSV");
  }
  if (std::any_of(head.begin(), head.end(), [](char c) { return c != '\0' && isControl(c); })) {
    throw std::runtime_error(name +
                             ": is not text; sbus reads a receiver's raw bytes if the file is called "
                             "NAME.bin or NAME.raw, or from standard input: - <" +
                             name);
  }
  return rows ? FileKind::Rows : isHexText(head) ? FileKind::Bytes : FileKind::Recording;
}

FileSource readFile(const FileName &name, const line::Overrides &overrides) {
  line::PackedFile probe(name.path, name.shown);
  if (probe.isSession()) {
    return readCapture(name, overrides);
  }
  probe.findOnly();
  const std::string unpacked = probe.unpackedName();
  const std::string head = line::TextFile(probe).read(line::CaptureHeadMax);
  if (head.empty()) {
    probe.requireEnd();
  }
  const bool isBinary = name.path != name.shown ? std::any_of(head.begin(), head.end(), isControl)
                                                : hasBytesExtension(unpacked) && head.rfind("<SALEAE>", 0) != 0;
  const FileKind kind = isBinary && !head.empty() ? FileKind::Bytes : kindOfText(head, name.shown);
  if (kind != FileKind::Capture && !overrides.signal.empty()) {
    throw std::runtime_error("--signal: is for a capture of several signals; leave it out for " + name.shown);
  }
  if (kind == FileKind::Capture) {
    return readCapture(name, overrides);
  }
  if (kind != FileKind::Bytes) {
    FileSource source = headOf(kind, head, overrides.baud);
    source.path = name.path;
    return source;
  }
  line::PackedFile file(name.path, name.shown);
  file.findOnly();
  return readBytes(file, name.shown, !isBinary, overrides.baud);
}

FileSource headOfPipe(FileKind kind, const std::string &head, unsigned long baud) {
  return headOf(kind, head, baud);
}

std::unique_ptr<LineReader> makeReader(const FileSource &source) {
  if (source.kind == FileKind::Json) {
    return std::make_unique<JsonReader>(source.settings);
  }
  if (source.kind == FileKind::Table) {
    return std::make_unique<TableReader>(source.settings);
  }
  return std::make_unique<RecordingLines>(source.settings.characterUs(), source.kind == FileKind::Rows);
}

std::optional<FileKind> liveKind(const std::string &begin) {
  const std::string_view text = line::withoutMark(begin);
  const size_t first = text.find_first_not_of(" \t\r\n");
  const size_t end = text.rfind('\n');
  if (first == std::string_view::npos || end == std::string_view::npos || end < first) {
    return std::nullopt;
  }
  if (text[first] == '{') {
    return readJsonHead(text).isKnown ? std::optional(FileKind::Json) : std::nullopt;
  }
  if (text.substr(first, RecordedBy.size()) == RecordedBy) {
    std::string_view rest = text.substr(first);
    while (!rest.empty() && rest.front() == '#') {
      line::takeLine(rest);
    }
    return rest.empty() ? std::nullopt : std::optional(FileKind::Recording);
  }
  return frameTable(text.substr(0, end + 1)) == FrameTable::Yes ? std::optional(FileKind::Table) : std::nullopt;
}

}  // namespace tool
