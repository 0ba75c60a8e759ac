// Words and numbers of a text, fast: no streams, no locale.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace line {

constexpr bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

constexpr bool isDigit(char c) {
  return c >= '0' && c <= '9';
}

constexpr bool isAscii(char c) {
  return static_cast<unsigned char>(c) < 0x80;
}

// Takes the next line off `text`, without its LF and CR.
inline std::string_view takeLine(std::string_view &text) {
  const size_t size = text.find('\n');
  std::string_view line = text.substr(0, size);
  text.remove_prefix(size == std::string_view::npos ? text.size() : size + 1);
  if (!line.empty() && line.back() == '\r') {
    line.remove_suffix(1);
  }
  return line;
}

// Without the blanks and quotation marks around it.
std::string_view trimmed(std::string_view text);

// In lower case.
std::string lower(std::string_view text);

// Takes a decimal number ("-1.25e-03") off the front; false if there is none. `mark`: stands for the decimal point,
// too.
bool takeNumber(const char *&at, const char *end, double &value, char mark = '.');

// True if all of `word` is a number.
bool parseNumber(std::string_view word, double &value, char mark = '.');

// True if `word` is a time as ISO 8601 has it ("2021-05-11T18:12:30.213141000+00:00"). `ns`: since 1970, where it was
// taken.
bool parseTimestamp(std::string_view word, int64_t &ns);

}  // namespace line
