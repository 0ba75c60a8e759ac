// Lines and words of a text.
#pragma once

#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>
#include <vector>

namespace line {

// Returns true for a blank; CR counts as one, so that CRLF files are read.
constexpr bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

constexpr bool isDigit(char c) { return c >= '0' && c <= '9'; }

// Returns true for a character that no text has. ESC begins the colours of a terminal.
constexpr bool isControl(char c) { return c >= '\0' && c < ' ' && !isBlank(c) && c != '\x1b'; }

// Returns the text without leading and trailing blanks and `mark`s.
inline std::string_view withoutBlanks(std::string_view text, char mark = ' ') {
  const auto goes = [mark](char c) { return isBlank(c) || c == mark; };
  while (!text.empty() && goes(text.front())) {
    text.remove_prefix(1);
  }
  while (!text.empty() && goes(text.back())) {
    text.remove_suffix(1);
  }
  return text;
}

inline std::string lower(std::string_view text) {
  std::string small(text);
  for (char &c : small) {
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return small;
}

// Returns the text without the byte order mark that some editors put before it.
inline std::string_view withoutMark(std::string_view text) {
  constexpr std::string_view Mark = "\xEF\xBB\xBF";
  return text.substr(0, Mark.size()) == Mark ? text.substr(Mark.size()) : text;
}

// Removes the next line from `text` and returns it without its LF and CR.
inline std::string_view takeLine(std::string_view &text) {
  const size_t size = text.find('\n');
  std::string_view line = text.substr(0, size);
  text.remove_prefix(size == std::string_view::npos ? text.size() : size + 1);
  if (!line.empty() && line.back() == '\r') {
    line.remove_suffix(1);
  }
  return line;
}

// Removes the next word from `text` and returns it; "" at the end.
inline std::string_view takeWord(std::string_view &text) {
  const auto begin = std::find_if_not(text.begin(), text.end(), isBlank);
  const auto end = std::find_if(begin, text.end(), isBlank);
  const std::string_view word =
      text.substr(static_cast<size_t>(begin - text.begin()), static_cast<size_t>(end - begin));
  text.remove_prefix(static_cast<size_t>(end - text.begin()));
  return word;
}

// Reads digits in this base, without a sign. Returns false for any other word, and for a number beyond Number's range.
template <typename Number>
bool parseWhole(std::string_view word, Number &value, int base = 10) {
  const char *const end = word.data() + word.size();
  const auto read = std::from_chars(word.data(), end, value, base);
  return read.ec == std::errc() && read.ptr == end;
}

// Calls `take` with each text between commas, unchanged; once, with an empty text, if `text` is empty.
template <typename Take>
void forEachBetweenCommas(std::string_view text, const Take &take) {
  for (size_t begin = 0; begin != std::string_view::npos;) {
    const size_t comma = text.find(',', begin);
    take(text.substr(begin, comma - begin));
    begin = comma == std::string_view::npos ? comma : comma + 1;
  }
}

// Formats a wrong word for a message on a terminal: in quotation marks, and cut if it is long.
inline std::string quoted(std::string_view word) {
  constexpr size_t Shown = 20;
  std::string text = "\"";
  for (const char c : word.substr(0, Shown)) {
    text += c >= ' ' && c <= '~' ? c : '?';
  }
  return text + (word.size() > Shown ? "...\"" : "\"");
}

// The cells of a row of CSV.
using Fields = std::vector<std::string_view>;

// Splits a row. A separator at its end does not begin another cell; a blank as separator is any number of blanks. Takes
// blanks and `mark`s off each cell.
inline void splitRow(std::string_view row, char separator, Fields &fields, char mark = '"') {
  fields.clear();
  while (separator == ' ' && !withoutBlanks(row).empty()) {
    fields.push_back(takeWord(row));
  }
  while (separator != ' ' && !row.empty()) {
    const size_t size = row.find(separator);
    fields.push_back(withoutBlanks(row.substr(0, size), mark));
    row.remove_prefix(size == std::string_view::npos ? row.size() : size + 1);
  }
}

}  // namespace line
