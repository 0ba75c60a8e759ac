#include "Recording.h"

#include <string_view>

namespace host {

namespace {

// CR is one too: that makes CRLF files good.
bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

// Takes the next word off `text`; empty at the end.
std::string_view takeWord(std::string_view &text) {
  while (!text.empty() && isBlank(text.front())) {
    text.remove_prefix(1);
  }
  size_t size = 0;
  while (size < text.size() && !isBlank(text[size])) {
    size++;
  }
  const std::string_view word = text.substr(0, size);
  text.remove_prefix(size);
  return word;
}

bool parseTime(std::string_view word, uint64_t &us) {
  us = 0;
  for (const char c : word) {
    if (c < '0' || c > '9') {
      return false;
    }
    us = us * 10 + static_cast<uint64_t>(c - '0');
    if (us > RecordingTimeMaxUs) {
      return false;
    }
  }
  return !word.empty();
}

int hexDigit(char c) {
  if (c >= '0' && c <= '9') {
    return c - '0';
  }
  if (c >= 'A' && c <= 'F') {
    return c - 'A' + 10;
  }
  return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

bool parseByte(std::string_view word, uint8_t &byte) {
  unsigned value = 0;
  for (const char c : word) {
    const int digit = hexDigit(c);
    if (digit < 0) {
      return false;
    }
    value = value << 4 | static_cast<unsigned>(digit);
  }
  byte = static_cast<uint8_t>(value);
  return word.size() == 1 || word.size() == 2;
}

// A word as it may be shown on a terminal.
std::string quoted(std::string_view word) {
  constexpr size_t Shown = 20;
  std::string text = "\"";
  for (const char c : word.substr(0, Shown)) {
    text += c >= ' ' && c <= '~' ? c : '?';
  }
  return text + (word.size() > Shown ? "...\"" : "\"");
}

// Reads a line without its LF; of a line that is too long only the beginning. False at the end of the file.
bool readLine(std::istream &in, std::string &line) {
  line.clear();
  for (int c = in.get(); c != std::istream::traits_type::eof(); c = in.get()) {
    if (c == '\n') {
      return true;
    }
    line += static_cast<char>(c);
    if (line.size() > RecordingLineMax) {
      return true;
    }
  }
  return !line.empty();
}

// Appends the characters of a line. Returns what is wrong with it, or nothing.
std::string parseLine(std::string_view line, uint32_t characterUs, std::vector<Character> &characters) {
  const std::string_view timeWord = takeWord(line);
  if (timeWord.empty() || timeWord.front() == '#') {
    return {};
  }
  Character character;
  if (!parseTime(timeWord, character.endUs)) {
    return quoted(timeWord) + " is not a time: a whole number of microseconds is expected, or a # comment";
  }
  if (!characters.empty() && character.endUs < characters.back().endUs + characterUs) {
    return "time " + std::to_string(character.endUs) + " is too early: the character before it was complete at " +
           std::to_string(characters.back().endUs) + " us, and each takes " + std::to_string(characterUs) + " us";
  }
  std::string_view word = takeWord(line);
  if (word.empty()) {
    return "there is a time, but no characters: bytes in hexadecimal are expected behind it";
  }
  for (; !word.empty(); word = takeWord(line)) {
    if (!parseByte(word, character.value)) {
      return quoted(word) + " is not a byte: one or two hexadecimal digits are expected";
    }
    characters.push_back(character);
    character.endUs += characterUs;
  }
  return {};
}

}  // namespace

Recording parseRecording(std::istream &in, uint32_t characterUs) {
  Recording recording;
  std::string line;
  for (unsigned number = 1; recording.error.empty() && readLine(in, line); number++) {
    if (line.size() > RecordingLineMax) {
      recording.error = "line is too long: at most " + std::to_string(RecordingLineMax) + " characters are expected";
    } else {
      recording.error = parseLine(line, characterUs, recording.characters);
    }
    if (!recording.error.empty()) {
      recording.errorLine = number;
    }
  }
  if (recording.error.empty() && in.bad()) {
    recording.error = "cannot be read";
  }
  if (recording.error.empty() && recording.characters.empty()) {
    recording.error = "is empty: at least one line \"microseconds byte byte ...\" is expected";
  }
  return recording;
}

}  // namespace host
