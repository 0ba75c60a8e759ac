#include "cli/Pipe.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "cli/Stop.h"
#include "line/file/Mangled.h"
#include "line/file/TableReader.h"
#include "line/capture/PackedFile.h"
#include "line/recording/Recording.h"
#include "line/recording/Words.h"
#include "line/system/System.h"

namespace tool {

namespace {

constexpr int WaitMs = 50;
constexpr int PauseMs = 100;  // a sketch's rows pause for this long, a file does not
constexpr double NoteAfterS = 2;

enum class Look { Unknown, Bytes, Packed, Text };

// 0F, the header of each S.Bus frame, does not occur in text. Text has few characters beyond ASCII, such as a micro
// sign.
Look lookOf(const std::string &begin, bool ended) {
  constexpr size_t Enough = sbus::FrameSize24;
  constexpr std::string_view Little("\xFF\xFE", 2), Big("\xFE\xFF", 2);
  if (line::isPacked(begin)) {
    return Look::Packed;
  }
  if (line::mayBePacked(begin) && !ended) {
    return Look::Unknown;
  }
  const std::string_view mark = std::string_view(begin).substr(0, Little.size());
  const bool maybeUtf16 = Little.substr(0, mark.size()) == mark || Big.substr(0, mark.size()) == mark;
  if (maybeUtf16 && begin.size() >= 4 && begin[mark == Little ? 3 : 2] == 0) {
    return Look::Text;
  }
  if (maybeUtf16 && begin.size() < 4 && !ended) {
    return Look::Unknown;
  }
  if (std::any_of(begin.begin(), begin.end(), line::isControl)) {
    return Look::Bytes;
  }
  const auto others = std::count_if(begin.begin(), begin.end(), [](char c) { return c < 0; });
  const bool isText = 4 * static_cast<size_t>(others) < begin.size();
  return begin.size() < Enough && !ended ? Look::Unknown : isText ? Look::Text : Look::Bytes;
}

// Returns true if the text is a sketch's rows. Rows that may be frames are not, unless no others come: `isAll`.
bool isSketchCsv(const std::string &begin, bool isAll) {
  const std::string head = begin.substr(0, begin.rfind('\n') + 1);
  const bool mayBeFrames = !isAll && line::frameTable(line::withoutMark(head)) == line::FrameTable::Maybe;
  return !mayBeFrames && line::readFileHead(head, "").kind == line::FileKind::Rows;
}

}  // namespace

Pipe::Pipe(std::string name) : _name(std::move(name)) {
  if (_name == "-") {
    _file = STDIN_FILENO;
  } else if (isPipe(_name)) {
    _file = open(_name.c_str(), O_RDONLY | line::CloseOnExec);
    if (_file < 0) {
      throw std::runtime_error(_name + ": cannot be opened (" + std::strerror(errno) +
                               "); name a pipe that can be read");
    }
  }
}

Pipe::~Pipe() {
  for (const int file : {_file, _copy}) {
    if (file > STDIN_FILENO) {
      close(file);
    }
  }
}

bool Pipe::isPipe(const std::string &name) {
  struct stat status;
  return name == "-" || (stat(name.c_str(), &status) == 0 && S_ISFIFO(status.st_mode));
}

Pipe::Content Pipe::content(double seconds) {
  struct stat status;
  if (fstat(_file, &status) != 0 || isatty(_file) != 0 || S_ISREG(status.st_mode)) {
    return S_ISREG(status.st_mode) ? Content::File : Content::Line;
  }
  const auto start = std::chrono::steady_clock::now();
  bool isSaid = false;
  std::optional<Content> content;
  while (!content && !stopped() && _begin.size() < line::FileHeadMax) {
    const bool came = readMore(_begin.empty() ? WaitMs : PauseMs);
    const double waited = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (_begin.empty() && !_ended && waited >= NoteAfterS && !std::exchange(isSaid, true)) {
      std::fprintf(stderr, "%s: no bytes yet\n", _name.c_str());
    }
    content = contentSoFar(!came, !came && seconds > 0 && waited >= seconds);
  }
  return content.value_or(_begin.empty() ? Content::Line : Content::File);
}

std::optional<Pipe::Content> Pipe::contentSoFar(bool isPause, bool isOver) {
  const Look look = lookOf(_begin, _ended);
  if (_begin.empty() ? _ended || isOver : look == Look::Bytes) {
    return Content::Line;
  }
  _textKind = look == Look::Packed ? std::nullopt : line::liveKind(_begin);
  if (_textKind) {
    return Content::Text;
  }
  if (look == Look::Packed || _ended) {
    return Content::File;
  }
  if (look == Look::Unknown && isOver) {
    return Content::Line;
  }
  _hasRows = (isPause || _begin.size() >= line::RecordingBeginning) && isSketchCsv(_begin, isOver);
  return _hasRows ? std::optional(Content::Line) : std::nullopt;
}

// A line would take seconds for what a file delivers at once, up to its end, or more than a live line's programs can
// have kept back in their pipes.
bool Pipe::isFileAtOnce() {
  constexpr size_t Most = 256 * 1024;
  const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(PauseMs);
  while (!_ended && _begin.size() < Most && !stopped()) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
    if (left.count() <= 0 || !readMore(static_cast<int>(left.count()))) {
      break;
    }
  }
  return _ended || _begin.size() >= Most;
}

bool Pipe::isMangled() {
  return !_hasRows && isFileAtOnce() &&
         !line::Mangled(std::string_view(_begin).substr(0, line::FileHeadMax)).what.empty();
}

// Reads the bytes that arrive within `ms`. Returns false if there were none.
bool Pipe::readMore(int ms) {
  if (!line::isReadable(_file, ms)) {
    return false;
  }
  char bytes[4096];
  const ssize_t count = read(_file, bytes, sizeof bytes);
  _ended = count == 0 || (count < 0 && errno != EINTR && errno != EAGAIN);
  _begin.append(bytes, count > 0 ? static_cast<size_t>(count) : 0);
  return count > 0;
}

FileName Pipe::wholeFile() {
  if (_file < 0) {
    return _name;
  }
  struct stat status;
  if (_begin.empty() && fstat(_file, &status) == 0 && S_ISREG(status.st_mode) && lseek(_file, 0, SEEK_CUR) == 0) {
    return {"/dev/stdin", _name};
  }
  if (_copy < 0) {
    _copy = line::copyToTemporary(_begin, _file, stopped);
    forgetStop();
  }
  return {"/dev/fd/" + std::to_string(_copy), _name};
}

}  // namespace tool
