// UTF-8 texts, measured in terminal columns.
#pragma once

#include <algorithm>
#include <numeric>
#include <string>

namespace tool {

// Returns how many columns a byte of UTF-8 takes: 1 if it begins a character, 2 if that is one of China, Japan or
// Korea, or an emoji; 0 within a character.
inline int columnsOf(char c) {
  const bool isWide = ('\xE3' <= c && c <= '\xED') || c == '\xF0';
  return (c & 0xC0) == 0x80 ? 0 : isWide ? 2 : 1;
}

inline int widthOf(const std::string &text) {
  return std::accumulate(text.begin(), text.end(), 0, [](int sum, char c) { return sum + columnsOf(c); });
}

// Returns as much of the text as fits.
inline std::string cut(const std::string &text, int width) {
  int columns = 0;
  size_t at = 0;
  while (at < text.size() && columns + columnsOf(text[at]) <= width) {
    columns += columnsOf(text[at++]);
  }
  return text.substr(0, at);
}

// Return the text cut or padded to exactly `width` columns. padded() adds blanks on the right, right() on the left.
inline std::string padded(const std::string &text, int width) {
  const int missing = width - widthOf(text);
  return missing > 0 ? text + std::string(static_cast<size_t>(missing), ' ') : cut(text, width);
}

inline std::string right(const std::string &text, int width) {
  const int missing = width - widthOf(text);
  return missing > 0 ? std::string(static_cast<size_t>(missing), ' ') + text : cut(text, width);
}

// Cuts after a title or a sentence: "Failsafe: the receiver works, but has lost the link." becomes "Failsafe".
inline std::string cutAtPhrase(const std::string &text, int width) {
  if (widthOf(text) <= width) {
    return text;
  }
  const std::string start = cut(text, width);
  const size_t end = std::max(start.rfind(": ") + 1, start.rfind(". ") + 1);  // npos + 1 is 0
  return end > 0 ? start.substr(0, end - 1) : start;
}

}  // namespace tool
