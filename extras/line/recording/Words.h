// Lines and words of a text.
#pragma once

#include <string>
#include <string_view>

namespace line {

// Returns true for a blank; CR counts as one, so that CRLF files are read.
constexpr bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

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

}  // namespace line
