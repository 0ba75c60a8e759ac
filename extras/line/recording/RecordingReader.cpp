#include "line/recording/RecordingReader.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "line/recording/CsvRows.h"
#include "line/recording/Words.h"

namespace line {

namespace {

constexpr int64_t LateMaxUs = UINT32_MAX;
constexpr const char *Empty = "is empty: at least one line \"microseconds byte byte ...\" is expected";

bool parseTime(std::string_view word, int64_t &us) {
  constexpr auto Most = static_cast<int64_t>(RecordingTimeMaxUs);
  return parseWhole(word, us) && us >= -Most && us <= Most;
}

// Takes "0F", or "0F!" for a character with an error.
bool parseCharacter(std::string_view word, Character &character) {
  character.bad = word.size() > 1 && word.back() == '!';
  word.remove_suffix(character.bad ? 1 : 0);
  return word.size() <= 2 && parseWhole(word, character.value, 16);
}

}  // namespace

std::string RecordingReader::line(std::string_view text, std::deque<Character> &characters) {
  const std::string wrong = take(text, characters);
  if (!wrong.empty()) {
    _lateReads.finish(characters);
  }
  return wrong;
}

std::string RecordingReader::take(std::string_view text, std::deque<Character> &characters) {
  text = std::exchange(_isFirst, false) ? withoutMark(text) : text;
  const size_t nul = text.find('\0');
  if (nul != std::string_view::npos) {
    _nuls += static_cast<unsigned long>(std::count(text.begin(), text.end(), '\0'));
    const size_t blank = text.substr(0, nul).rfind(' ');
    text = text.substr(0, blank == std::string_view::npos || blank == text.find(' ') ? 0 : blank);
  }
  if (text.size() > RecordingLineMax) {
    return "line is too long: at most " + std::to_string(RecordingLineMax) + " characters are expected";
  }
  const std::string_view timeWord = takeWord(text);
  if (timeWord.empty() || timeWord.front() == '#') {
    return {};
  }
  Character character;
  const size_t mark = timeWord.find('~');
  int64_t us = 0, lateUs = 0;
  if (!parseTime(timeWord.substr(0, mark), us) ||
      (mark != std::string_view::npos &&
       (!parseTime(timeWord.substr(mark + 1), lateUs) || lateUs < 0 || lateUs > LateMaxUs))) {
    return quoted(timeWord) +
           " is not a time: a whole number of microseconds is expected, or a # comment; "
           "without times, bytes such as 0F E3";
  }
  if (!_any) {
    begin(us < 0 ? us - _characterUs : us);
  }
  character.endUs = static_cast<uint64_t>(us - zeroUs());
  if (us < zeroUs() || (_any && character.endUs < _lastUs + _characterUs)) {
    return "time " + std::to_string(us) + " is too early: the previous character was complete at " +
           std::to_string(static_cast<int64_t>(_lastUs) + zeroUs()) + " us, and each takes " +
           std::to_string(_characterUs) + " us";
  }
  character.lateUs = static_cast<uint32_t>(lateUs);
  std::string_view word = takeWord(text);
  if (word.empty()) {
    return "there is a time, but no characters: bytes in hexadecimal are expected after it";
  }
  for (; !word.empty(); word = takeWord(text)) {
    if (!parseCharacter(word, character)) {
      return quoted(word) + " is not a byte: one or two hexadecimal digits are expected";
    }
    if (_isWhole) {
      _lateReads.put(character, characters);
    } else {
      characters.push_back(character);
    }
    _lastUs = character.endUs;
    _any = true;
    character.endUs += _characterUs;
  }
  return {};
}

std::string RecordingReader::finish(std::deque<Character> &characters) {
  _lateReads.finish(characters);
  _hasEnded = true;
  return _any ? "" : Empty;
}

std::string RecordingReader::news() {
  return _hasEnded && _nuls > 0
             ? std::to_string(_nuls) + " NULs were left out, and the lines that they cut: did the power fail?"
             : "";
}

// Without times, a row's first character is complete when the row comes; with times, its last one.
std::string RowsReader::line(std::string_view text, std::deque<Character> &characters) {
  constexpr uint64_t RowUs = 200000;
  constexpr uint32_t AtOnceUs = 1;  // makes room for 111 rows a second with 32 numbers each
  const std::string plain = withCommas(_any ? text : withoutMark(text));
  text = plain;
  const size_t comma = text.find(',');
  _hasTimes = _hasTimes || (!_any && hasTimeColumn(text));
  const bool isTimed = _hasTimes && comma != std::string_view::npos;
  const uint32_t characterUs = isTimed ? AtOnceUs : _characterUs;
  uint64_t us = (_lastUs / RowUs + 1) * RowUs;
  if (isTimed) {
    const double fileUs = std::strtod(std::string(text.substr(0, comma)).c_str(), nullptr) * 1e6;
    const int64_t rowUs = std::abs(fileUs) < RecordingTimeMaxUs ? std::llround(fileUs) : 0;
    if (!_any) {
      begin(rowUs < 0 ? rowUs - _characterUs : rowUs);
    }
    us = static_cast<uint64_t>(std::max<int64_t>(0, rowUs - zeroUs()));
    text = text.substr(comma + 1);
  }
  const std::string row = std::string(text.substr(0, RecordingLineMax / 2)) + '\n';
  if (_hasTimes) {
    us = std::max((_any ? _lastUs : 0) + characterUs, us - std::min<uint64_t>(us, (row.size() - 1) * characterUs));
  }
  for (const char c : row) {
    characters.push_back({us, static_cast<uint8_t>(c)});
    _lastUs = us;
    us += characterUs;
  }
  _any = true;
  return {};
}

std::string RowsReader::finish(std::deque<Character> & /*characters*/) { return _any ? "" : Empty; }

Recording parseRecording(std::string_view text, uint32_t characterUs) {
  Recording recording;
  RecordingReader reader(characterUs);
  std::deque<Character> came;
  unsigned number = 0;
  for (; recording.error.empty() && !text.empty(); number++) {
    recording.error = reader.line(takeLine(text), came);
    std::for_each(came.begin(), came.end(), [&](const Character &each) { recording.characters.push_back(each); });
    came.clear();
  }
  recording.errorLine = recording.error.empty() ? 0 : number;
  recording.error = recording.error.empty() ? reader.finish(came) : recording.error;
  recording.zeroUs = reader.zeroUs();
  return recording;
}

}  // namespace line
