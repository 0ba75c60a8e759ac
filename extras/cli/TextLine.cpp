#include "cli/TextLine.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "line/Format.h"
#include "line/system/System.h"

namespace tool {

namespace {

constexpr size_t Ahead = 2;          // characters: knownUs() needs the next one
constexpr uint64_t OldUs = 250000;   // a live text's characters that are this much older than its newest are left out
constexpr int64_t JitterUs = 20000;  // a pipe's: a live text's newest character is played so much later at most

}  // namespace

FileText::FileText(const std::string &path, const std::string &name, bool isRaw)
    : _file(path, name), _text(_file), _isRaw(isRaw) {
  _file.findOnly();
}

bool PipeText::isReady(int ms) { return !_begin.empty() || _ended || line::isReadable(_file, ms); }

std::string_view PipeText::read() {
  while (!_ended) {
    if (!_begin.empty()) {
      _read = std::exchange(_begin, {});
    } else {
      _read.resize(4096);
      const ssize_t count = ::read(_file, _read.data(), _read.size());
      if (count < 0 && (errno == EINTR || errno == EAGAIN)) {
        continue;
      }
      _failure = count < 0 ? std::string("cannot be read (") + std::strerror(errno) + ")" : "";
      _read.resize(count > 0 ? static_cast<size_t>(count) : 0);
    }
    _ended = _read.empty();
    const std::string_view text = _ended ? _plain.finish() : _plain.put(_read);
    if (!text.empty()) {
      return text;
    }
  }
  return {};
}

std::string emptyPart(int64_t firstUs, int64_t lastUs) {
  return line::format(": has no characters there; it has characters from %.3f s to %.3f s", line::seconds(firstUs),
                      line::seconds(lastUs));
}

TextLine::TextLine(std::string name, std::unique_ptr<TextInput> input, std::unique_ptr<line::LineReader> reader,
                   Clock clock, uint64_t fromUs, uint64_t toUs)
    : _name(std::move(name)),
      _lines(std::move(input)),
      _reader(std::move(reader)),
      _clock(clock),
      _fromUs(fromUs),
      _toUs(toUs) {}

bool TextLine::next(uint64_t nowUs, line::Character &character) {
  fill(nowUs);
  if (_waiting.empty() || playedUs(_waiting.front().endUs) > nowUs) {
    return false;
  }
  character = _waiting.front();
  character.endUs = playedUs(character.endUs);
  _lastUs = character.endUs;
  _waiting.pop_front();
  return true;
}

// Returns when a character that ends at `endUs` in the text is played; never before the previous one.
uint64_t TextLine::playedUs(uint64_t endUs) const {
  const int64_t us = static_cast<int64_t>(endUs) + _shiftUs;
  return std::max(us > 0 ? static_cast<uint64_t>(us) : 0, _lastUs);
}

uint64_t TextLine::knownUs(uint64_t nowUs) const {
  if (!_waiting.empty()) {
    const uint64_t nextUs = playedUs(_waiting.front().endUs);
    return std::min(nowUs, nextUs - std::min<uint64_t>(nextUs, line::CharacterUs + _waiting.front().lateUs));
  }
  if (_ended) {
    return nowUs;
  }
  const uint64_t lateUs = _clock == Clock::Live ? 2 * JitterUs : UINT64_MAX;
  return std::max(_lastUs, nowUs - std::min(nowUs, lateUs));
}

bool TextLine::wait() {
  if (!_waiting.empty() || _ended) {
    return false;
  }
  _lines.isReady(50);
  return true;
}

bool TextLine::canAdvanceTo(uint64_t us) {
  constexpr uint64_t TickUs = 1000;
  fill(us);
  return !_waiting.empty() || _ended || us <= _lastUs + TickUs;
}

bool TextLine::finished(uint64_t nowUs) const { return _ended && _waiting.empty() && nowUs >= _lastUs + line::TailUs; }

void TextLine::fill(uint64_t nowUs) {
  const bool isLive = _clock == Clock::Live;
  bool came = false;
  while (!_ended && (isLive || _waiting.size() < Ahead) && _lines.isReady(0)) {
    read();
    came = true;
  }
  if (isLive && !_ended) {
    _ages.empty();
  }
  if (came && isLive && _newestUs > 0) {
    followLive(nowUs);
  }
}

// Plays a live text's newest character at once, and those before it as much earlier as they are older.
void TextLine::followLive(uint64_t nowUs) {
  const int64_t aheadUs = static_cast<int64_t>(_newestUs) + _shiftUs - static_cast<int64_t>(nowUs);
  _shiftUs -= std::max<int64_t>(0, aheadUs) + std::min<int64_t>(0, aheadUs + JitterUs);
  while (!_waiting.empty() && _waiting.front().endUs + OldUs < _newestUs) {
    _waiting.pop_front();
  }
}

void TextLine::read() {
  _lines.read();
  if (_reader->takesBytes()) {
    take(_lines.takeAll());
  }
  for (std::string line; !_ended && _lines.take(line);) {
    take(line);
  }
  if (_lines.atEnd()) {
    takeEnd();
  }
}

void TextLine::take(const std::string &line) {
  const size_t from = _waiting.size();
  const std::string wrong = !_lines.wrong().empty() ? _lines.wrong()
                            : _lines.isCut()        ? _reader->cutLine(line, _waiting)
                                                    : _reader->line(line, _waiting);
  const std::string news = _reader->news();
  if (!news.empty()) {
    _news = _name + ":" + std::to_string(_lines.number()) + ": " + news;
  }
  setAges(from);
  keepPart(from);
  if (!wrong.empty()) {
    _failure = _name + ":" + std::to_string(_lines.number()) + ": " + wrong;
    _ended = true;
  }
}

// A file has no age, even if its lines say when they were read.
void TextLine::setAges(size_t from) {
  const bool isLive = _clock == Clock::Live;
  if (from == _waiting.size() || (isLive && _waiting.back().sinceUs > 0)) {
    return;
  }
  const uint64_t sinceUs = isLive ? _ages.came((_waiting.size() - from) * line::CharacterUs) : 0;
  for (size_t i = from; i < _waiting.size(); i++) {
    _waiting[i].sinceUs = sinceUs;
  }
}

// Removes the characters from index `from` on that do not end between _fromUs and _toUs.
void TextLine::keepPart(size_t from) {
  size_t kept = from;
  for (size_t i = from; i < _waiting.size(); i++) {
    const line::Character character = _waiting[i];
    _firstUs = _firstUs == 0 ? character.endUs : _firstUs;
    _newestUs = character.endUs;
    if (character.endUs >= _fromUs && (_toUs == 0 || character.endUs <= _toUs)) {
      _waiting[kept++] = character;
    }
  }
  _waiting.resize(kept);
  _any = _any || kept > from;
  _ended = _ended || (_toUs > 0 && _newestUs > _toUs && _any);
}

void TextLine::takeEnd() {
  const bool failed = std::exchange(_ended, true) && !_failure.empty();
  if (failed) {
    return;
  }
  const std::string unread = _lines.failure();
  const size_t from = _waiting.size();
  const std::string missing = _reader->finish(_waiting);
  keepPart(from);
  const std::string news = _reader->news();
  _news += news.empty() ? "" : _name + ": " + news;
  if (!unread.empty() || !missing.empty()) {
    _failure = _name + ": " + (unread.empty() ? missing : unread);
  } else if (!_any) {
    const int64_t zeroUs = _reader->zeroUs();
    _failure = _name + emptyPart(static_cast<int64_t>(_firstUs) + zeroUs, static_cast<int64_t>(_newestUs) + zeroUs);
  }
}

}  // namespace tool
