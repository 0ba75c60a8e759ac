#include "line/recording/Recording.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "line/recording/CsvRows.h"
#include "line/recording/WallTime.h"
#include "line/recording/Words.h"

namespace line {

namespace {

constexpr int64_t LateMaxUs = UINT32_MAX;

bool parseTime(std::string_view word, int64_t &us) {
  constexpr auto Most = static_cast<int64_t>(RecordingTimeMaxUs);
  return parseWhole(word, us) && us >= -Most && us <= Most;
}

// Takes "0F", or "0F!" for a character with an error.
bool parseCharacter(std::string_view word, Character &character) {
  character.bad = word.size() > 1 && word.back() == '!';
  if (character.bad) {
    word.remove_suffix(1);
  }
  return word.size() <= 2 && parseWhole(word, character.value, 16);
}

// Returns true for a line of column names that begins with a channel: "CH1,CH2".
bool beginsWithChannel(std::string_view text) {
  size_t digits = 2;
  while (digits < text.size() && isDigit(text[digits])) {
    digits++;
  }
  return lower(text.substr(0, 2)) == "ch" && digits > 2 && digits < text.size() &&
         (text[digits] == ',' || text[digits] == '\r' || text[digits] == '\n');
}

}  // namespace

bool hasTimeColumn(std::string_view text) {
  const std::string_view first = text.substr(0, text.find(','));
  return first == "time" || first == "seconds";
}

LineSettings settingsIn(std::string_view beginning) {
  LineSettings settings;
  beginning = withoutMark(beginning);
  while (!beginning.empty() && beginning.front() == '#') {
    const std::string comment(takeLine(beginning));
    const size_t end = comment.find(" baud");
    if (end == std::string::npos || comment.find_first_not_of("0123456789", 2) != end) {
      continue;
    }
    const unsigned long baud = std::strtoul(comment.c_str() + 2, nullptr, 10);
    if (comment.find("8N1", end) != std::string::npos) {
      settings = csvSettings();
      settings.baud = std::clamp(baud, 1ul, 10000000ul);
      return settings;
    }
    settings.baud = baud == 2 * sbus::Baud ? baud : sbus::Baud;
    return settings;
  }
  return settings;
}

std::optional<int64_t> startIn(std::string_view beginning) {
  beginning = withoutMark(beginning);
  while (!beginning.empty() && beginning.front() == '#') {
    const std::string_view comment = withoutBlanks(takeLine(beginning).substr(1));
    int64_t us = 0;
    if (comment.substr(0, BeganText.size()) == BeganText && parseWallTime(comment.substr(BeganText.size()), us)) {
      return us;
    }
  }
  return std::nullopt;
}

bool isCsvText(std::string_view beginning) {
  beginning = withoutMark(beginning);
  if (hasTimeColumn(beginning) || beginsWithChannel(beginning)) {
    return true;
  }
  CsvRows rows;
  for (const char c : beginning) {
    rows.put(static_cast<uint8_t>(c));
    if (rows.recognised() && rows.isTable()) {
      return true;
    }
  }
  return false;
}

// Takes a comment without its #. Only bookmarks have a meaning.
void RecordingReader::comment(std::string_view text) {
  const std::string_view word = takeWord(text);
  Bookmark bookmark{};
  if (word == "bookmarks") {
    _recording.bookmarks.clear();
  } else if (word == "bookmark" && parseTime(takeWord(text), bookmark.us)) {
    bookmark.name = withoutBlanks(text);
    _recording.bookmarks.push_back(std::move(bookmark));
  }
}

// Takes the characters of a line. Returns what is wrong with it, or nothing.
std::string RecordingReader::parse(std::string_view line) {
  const std::string_view timeWord = takeWord(line);
  if (timeWord.empty() || timeWord.front() == '#') {
    if (timeWord == "#") {
      comment(line);
    }
    return {};
  }
  Character character;
  const size_t mark = timeWord.find('~');
  int64_t us = 0, lateUs = 0;
  if (!parseTime(timeWord.substr(0, mark), us) ||
      (mark != std::string_view::npos &&
       (!parseTime(timeWord.substr(mark + 1), lateUs) || lateUs < 0 || lateUs > LateMaxUs))) {
    return quoted(timeWord) + " is not a time: a whole number of microseconds is expected, or a # comment";
  }
  if (!place(us, character.endUs) || (_any && character.endUs < _last.endUs + _characterUs)) {
    return "time " + std::to_string(us) + " is too early: the previous character was complete at " +
           std::to_string(static_cast<int64_t>(_last.endUs) + _recording.zeroUs) + " us, and each takes " +
           std::to_string(_characterUs) + " us";
  }
  character.lateUs = static_cast<uint32_t>(lateUs);
  std::string_view word = takeWord(line);
  if (word.empty()) {
    return "there is a time, but no characters: bytes in hexadecimal are expected after it";
  }
  for (; !word.empty(); word = takeWord(line)) {
    if (!parseCharacter(word, character)) {
      return quoted(word) + " is not a byte: one or two hexadecimal digits are expected";
    }
    put(character);
    character.endUs += _characterUs;
  }
  return {};
}

// Converts the file's time; the first character sets where times begin. Returns false if it is before that.
bool RecordingReader::place(int64_t us, uint64_t &endUs) {
  _recording.zeroUs = _any ? _recording.zeroUs : std::min<int64_t>(0, us - _characterUs);
  _recording.zeroUs = us >= 0 && !_any ? 0 : _recording.zeroUs;
  endUs = static_cast<uint64_t>(us - _recording.zeroUs);
  return us >= _recording.zeroUs;
}

void RecordingReader::row(std::string_view text) {
  constexpr uint64_t RowUs = 200000;
  constexpr uint32_t AtOnceUs = 1;  // makes room for 111 rows a second with 32 numbers each
  const size_t comma = text.find(',');
  _hasTimes = _hasTimes || (!_any && hasTimeColumn(text));
  if (!_hasTimes || comma == std::string_view::npos) {
    putRow(text, (_any ? _last.endUs / RowUs + 1 : 1) * RowUs, _characterUs);
    return;
  }
  const double seconds = std::strtod(std::string(text.substr(0, comma)).c_str(), nullptr);
  uint64_t us = 0;
  if (!place(std::abs(seconds * 1e6) < RecordingTimeMaxUs ? std::llround(seconds * 1e6) : 0, us)) {
    us = 0;
  }
  putRow(text.substr(comma + 1), us, AtOnceUs);
}

// Adds a row. Its first character is complete at `endUs`; its last one, if rows have times.
void RecordingReader::putRow(std::string_view text, uint64_t endUs, uint32_t characterUs) {
  const std::string row = std::string(text.substr(0, RecordingLineMax / 2)) + '\n';
  if (_hasTimes) {
    const uint64_t earliestUs = _any ? _last.endUs + characterUs : characterUs;
    endUs = std::max(earliestUs, endUs - std::min<uint64_t>(endUs, (row.size() - 1) * characterUs));
  }
  Character character;
  character.endUs = endUs;
  for (const char c : row) {
    character.value = static_cast<uint8_t>(c);
    put(character);
    character.endUs += characterUs;
  }
}

void RecordingReader::put(const Character &character) {
  _recording.characters.push_back(character);
  _last = character;
  _any = true;
}

void RecordingReader::line(std::string_view text) {
  if (!_recording.error.empty()) {
    return;
  }
  if (_number == 0 && !_any) {
    text = withoutMark(text);
  }
  if (_csv) {
    row(text);
    return;
  }
  _number++;
  const size_t nul = text.find('\0');
  if (nul != std::string_view::npos) {
    _nuls += static_cast<unsigned long>(std::count(text.begin(), text.end(), '\0'));
    const size_t blank = text.substr(0, nul).rfind(' ');
    text = text.substr(0, blank == std::string_view::npos || blank == text.find(' ') ? 0 : blank);
  }
  _recording.error = text.size() > RecordingLineMax
                         ? "line is too long: at most " + std::to_string(RecordingLineMax) + " characters are expected"
                         : parse(text);
  _recording.errorLine = _recording.error.empty() ? 0 : _number;
}

Recording RecordingReader::finish() {
  if (_recording.error.empty() && !_any) {
    _recording.error = "is empty: at least one line \"microseconds byte byte ...\" is expected";
  }
  return std::move(_recording);
}

Recording parseRecording(std::string_view text, uint32_t characterUs) {
  RecordingReader reader(characterUs);
  while (!text.empty()) {
    reader.line(takeLine(text));
  }
  return reader.finish();
}

}  // namespace line
