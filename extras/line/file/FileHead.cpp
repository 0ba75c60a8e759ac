#include "line/file/FileHead.h"

#include <algorithm>

#include "line/ReadAtBaud.h"
#include "line/capture/Capture.h"
#include "line/file/BytesReader.h"
#include "line/file/DecodedReader.h"
#include "line/file/JsonReader.h"
#include "line/file/Mangled.h"
#include "line/file/OtherText.h"
#include "line/file/TableReader.h"
#include "line/recording/CsvRows.h"
#include "line/recording/PlainText.h"
#include "line/recording/RecordingReader.h"
#include "line/recording/Words.h"

namespace line {

namespace {

constexpr std::string_view RecordedBy = "# sbus ";  // the beginning of a recording made by sbus

// Returns true for bytes that are no text: each frame of S.Bus has its header, 0F, and zeros. NULs alone are what a
// file system leaves of a recording after a power cut.
bool isRaw(std::string_view begin) {
  const auto others =
      static_cast<size_t>(std::count_if(begin.begin(), begin.end(), [](char c) { return c != '\0' && isControl(c); }));
  return 50 * others > begin.size() - static_cast<size_t>(std::count(begin.begin(), begin.end(), '\0'));
}

// Returns true for a text whose first line is a recording's: a time, then bytes in hexadecimal. Two digits are a time
// only in a single line of a frame at most: lines are further apart than that.
bool isRecording(std::string_view text) {
  std::string_view times[2];
  size_t bytes = 0;
  for (size_t lines = 0; lines < 2 && !text.empty();) {
    std::string_view line = takeLine(text);
    const std::string_view time = takeWord(line);
    if (time.empty() || time.front() == '#') {
      continue;
    }
    times[lines++] = time.substr(0, time.find('~'));
    std::string_view digits = times[lines - 1];
    digits.remove_prefix(digits.front() == '-' ? 1 : 0);
    bool isByte = lines == 2 || !withoutBlanks(line).empty();
    for (std::string_view word = takeWord(line); !word.empty() && lines == 1; word = takeWord(line)) {
      bytes++;
      isByte = isByte && word.size() <= 3 && (word.size() < 3 || word.back() == '!');
    }
    if (!isByte || digits.empty() || !std::all_of(digits.begin(), digits.end(), isDigit)) {
      return lines == 2 && times[0].size() != 2;
    }
  }
  return !times[0].empty() && !(times[0].size() == 2 && (times[1].size() == 2 || bytes > sbus::FrameSize24));
}

// An oscilloscope's columns look like a sketch's rows with times; but no receiver is seen in rows further apart than
// this.
bool areSamples(const CaptureForm &form, std::string_view text) {
  constexpr double SampleMostNs = 500000;
  const bool mayBeRows = form.name == OscilloscopeFormat || hasTimeColumn(text);
  return !form.name.empty() && (!mayBeRows || (form.periodNs > 0 && form.periodNs < SampleMostNs));
}

FileHead wrong(const std::string &error) {
  FileHead head;
  head.kind = FileKind::Wrong;
  head.error = error;
  return head;
}

}  // namespace

FileKind kindOfText(std::string_view text) {
  const std::string_view begin = withoutBlanks(text);
  const std::string_view inside = withoutBlanks(begin.substr(begin.substr(0, 1) == "{" ? 1 : begin.size()));
  if (!inside.empty() && (inside.front() == '"' || inside.front() == '}')) {
    return FileKind::Json;
  }
  if (begin.substr(0, 1) == "[" && withoutBlanks(begin.substr(1)).substr(0, 1) == "{" &&
      withoutBlanks(withoutBlanks(begin.substr(1)).substr(1)).substr(0, 6) == "\"type\"") {
    return FileKind::Json;  // jq -s makes one array of the lines, which is rejected
  }
  if (DecodedReader::reads(text)) {
    return FileKind::Decoded;
  }
  if (frameTable(text) == FrameTable::Yes) {
    return FileKind::Table;
  }
  if (areSamples(captureForm(text), text)) {
    return FileKind::Capture;
  }
  const ByteText bytes(text, text.size() < FileHeadMax);
  const bool areRows = isCsvText(text.substr(0, RecordingBeginning));
  if (bytes.isBytes() &&
      (areRows ? BytesReader(text, true, LineSettings()).hasFrames() : bytes.isList() || bytes.hasOffsets())) {
    return FileKind::Text;
  }
  if (areRows) {
    return FileKind::Rows;
  }
  return bytes.isBytes() && !isRecording(text) ? FileKind::Text : FileKind::Recording;
}

std::string whyNoCapture(FileKind kind, std::string_view begin) {
  const bool isOne = kind == FileKind::Recording && isRecording(begin);
  // A column of voltages, which --sample-rate tells the times of, may look like bytes as well.
  std::string_view text = withoutBlanks(begin), words = takeLine(text);
  takeWord(words);
  const bool isColumn = takeWord(words).empty() && !BytesReader(begin, true, LineSettings()).hasFrames();
  const bool areBytes = kind == FileKind::Bytes || (kind == FileKind::Text && !isColumn);
  const char *const what = isOne                       ? "a recording of characters"
                           : areBytes                  ? "bytes"
                           : kind == FileKind::Json    ? "JSON lines"
                           : kind == FileKind::Table   ? "a table of frames"
                           : kind == FileKind::Decoded ? "what sbus printed"
                                                       : nullptr;
  return what == nullptr ? ""
                         : std::string("is ") + what +
                               ", not a capture of the wire: sbus hex shows it, sbus wave makes a capture of it";
}

std::string exportOf(std::string_view begin, const std::string &name) {
  constexpr const char *Other = "is a picture, a document or a program: a recording, a capture or bytes are expected";
  constexpr const char *Packed = "is packed in a way that is not read here: unpack it, or pack it as .gz or .zip";
  const bool isText = !begin.empty() && begin.substr(0, 2) != "PK" && !isRaw(begin);
  const struct {
    std::string_view begin, entry, end;
    const char *what;
  } rows[] = {
      {"<SALEAE>", "", "", "is Logic 2's binary export: export it as CSV"},
      {"", "meta.json", ".sal", "is a capture of Saleae's Logic 2: export it as CSV (File, Export Raw Data)"},
      {"", "header", ".dsl", "is a capture of DSView: export it as CSV (File, Export)"},
      {"", "", ".logicdata", "is a capture of Saleae's Logic 1: export it as CSV or VCD"},
      {"", "", ".scana", "is a workspace of ScanaStudio: export it as CSV or VCD"},
      {"", "", ".psdata", "is a file of PicoScope: save it as CSV (File, Save As)"},
      {"BZh", "", "", Packed},
      {"\x28\xB5\x2F\xFD", "", "", Packed},  // zstd
      {"7z\xBC\xAF", "", "", Packed},
      {"\xFD"
       "7zXZ",
       "", "", Packed},  // the command has unpacked it
      {"Rar!", "", "", Packed},
      {"\x89PNG", "", "", Other},
      {"\xC2\x89PNG", "", "", Other},
      {"\xFF\xD8\xFF", "", "", Other},
      {"GIF8", "", "", Other},
      {"%PDF-", "", "", Other},
      {"\x7F"
       "ELF",
       "", "", Other},
  };
  const std::string small = lower(name);
  for (const auto &row : rows) {
    const bool hasEnd = !row.end.empty() && small.size() > row.end.size() &&
                        small.compare(small.size() - row.end.size(), row.end.size(), row.end) == 0;
    const bool isEntry = !row.entry.empty() && begin.substr(0, 4) == "PK\x03\x04" && begin.size() >= 30 &&
                         begin.substr(30, row.entry.size()) == row.entry;
    if ((!row.begin.empty() && begin.substr(0, row.begin.size()) == row.begin) || (hasEnd && !isText) || isEntry) {
      return row.what;
    }
  }
  return {};
}

FileHead headOfText(FileKind kind, std::string_view begin, unsigned long baud) {
  FileHead head;
  head.kind = kind;
  head.begin = begin;
  if (kind == FileKind::Recording) {
    head.settings = settingsIn(begin.substr(0, RecordingBeginning));
    head.startUs = startIn(begin.substr(0, RecordingBeginning));
    head.isLate = begin.find('~') != std::string_view::npos;
  } else if (kind == FileKind::Rows) {
    head.settings = csvSettings();
    head.hasRowTimes = hasTimeColumn(begin);
  } else if (kind == FileKind::Json) {
    const JsonHead read = readJsonHead(begin);
    head.settings = read.settings;
    head.startUs = read.startUs;
    head.hasTimes = read.hasTimes;
    head.isRead = read.isRead;
  } else if (kind == FileKind::Decoded) {
    head.settings = DecodedReader::settings(begin);
  } else if (kind == FileKind::Bytes || kind == FileKind::Text) {
    head.hasTimes = false;
  }
  if (kind != FileKind::Rows && baud > 0) {
    head.settings = LineSettings();
    head.settings.baud = baud;
  }
  if (kind == FileKind::Bytes || kind == FileKind::Text) {
    const Mangled mangled(kind == FileKind::Text ? std::string_view() : begin);
    if (mangled.isLost) {
      return wrong(mangled.what + "; " + mangled.remedy);
    }
    const BytesReader reader(begin, kind == FileKind::Text, head.settings);
    if (!reader.mayBeLine()) {
      return wrong(reader.why());
    }
    head.note = reader.note();
    if (reader.readAtBaud() != 0 && !reader.hasFrames()) {
      head.damage = ReadAtBaud::finding(reader.readAtBaud());
      head.damageRemedy = ReadAtBaud::Remedy;
    }
    if (!mangled.what.empty()) {
      head.note += "; " + mangled.what + "; " + mangled.remedy;
      head.damage = "Changed bytes: " + mangled.what + ".";
      head.damageRemedy = mangled.remedy + ".";
      head.damageRemedy[0] = static_cast<char>(head.damageRemedy[0] - 'a' + 'A');
    }
  } else if (kind != FileKind::Capture) {
    const std::unique_ptr<LineReader> reader = makeReader(head);
    std::deque<Character> first;
    while (begin.find('\n') != std::string_view::npos && first.empty() &&
           reader->line(takeLine(begin), first).empty()) {
    }
    head.zeroUs = reader->zeroUs();
  }
  return head;
}

FileHead readFileHead(std::string_view begin, const std::string &name, unsigned long baud) {
  const std::string ownFormat = exportOf(begin, name);
  if (!ownFormat.empty()) {
    return wrong(ownFormat);
  }
  if (begin.substr(0, 2) == "\xFE\xFF") {
    return wrong("is text in UTF-16 with the mark FE FF: save it as UTF-8");
  }
  if (begin.substr(0, 2) != "\xFF\xFE" && isRaw(begin)) {
    return headOfText(FileKind::Bytes, begin, baud);
  }
  PlainText plain;
  std::string text(plain.put(begin));
  text += plain.finish();
  if (std::any_of(text.begin(), text.end(), [](char c) { return c != '\0' && isControl(c); })) {
    if (BytesReader(begin, false, LineSettings()).readAtBaud() != 0) {
      return headOfText(FileKind::Bytes, begin, baud);
    }
    return wrong("is neither text nor a receiver's bytes: a recording, a capture of the wire or bytes are expected");
  }
  const std::string other = whatText(text);
  return other.empty() ? headOfText(kindOfText(text), text, baud) : wrong(other);
}

std::unique_ptr<LineReader> makeReader(const FileHead &head, bool isWhole) {
  switch (head.kind) {
    case FileKind::Json:
      return std::make_unique<JsonReader>(head.settings);
    case FileKind::Table:
      return std::make_unique<TableReader>(head.settings);
    case FileKind::Decoded:
      return std::make_unique<DecodedReader>(head.settings);
    case FileKind::Bytes:
    case FileKind::Text:
      return std::make_unique<BytesReader>(head.begin, head.kind == FileKind::Text, head.settings);
    case FileKind::Recording:
      return std::make_unique<RecordingReader>(head.settings.characterUs(), isWhole);
    case FileKind::Rows:
      return std::make_unique<RowsReader>(head.settings.characterUs());
    case FileKind::Capture:
    case FileKind::Wrong:
      break;
  }
  return nullptr;
}

std::optional<FileKind> liveKind(const std::string &begin) {
  const std::string_view text = withoutMark(begin);
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
      takeLine(rest);
    }
    return rest.empty() ? std::nullopt : std::optional(FileKind::Recording);
  }
  return frameTable(text.substr(0, end + 1)) == FrameTable::Yes ? std::optional(FileKind::Table) : std::nullopt;
}

}  // namespace line
