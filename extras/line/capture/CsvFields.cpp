#include "line/capture/CsvFields.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "line/capture/Parsing.h"

namespace line {

namespace {

bool isNumber(std::string_view field) {
  double value;
  return parseNumber(field, value);
}

bool isVoltage(std::string_view field) {
  const char *at = field.data();
  const char *end = at + field.size();
  double volts;
  return (takeNumber(at, end, volts) || takeInfinity(at, end, volts)) && at == end;
}

bool isTimestamp(std::string_view field) {
  int64_t ns;
  return parseTimestamp(field, ns);
}

}  // namespace

bool isComment(std::string_view line) {
  if (line.substr(0, 2) == ",#") {  // Hantek's second line
    return true;
  }
  const bool alone = line.size() > 1 && Separators.find(line[1]) != std::string_view::npos;
  return !line.empty() && (line.front() == ';' || (line.front() == '#' && !alone));
}

bool isLogic(std::string_view field) {
  return field.size() == 1 && std::string_view("01xXzZ").find(field.front()) != std::string_view::npos;
}

bool isRow(const Fields &fields) {
  const auto fits = [](std::string_view field) {
    return field.empty() || isLogic(field) || isVoltage(field) || isTimestamp(field);
  };
  return std::all_of(fields.begin(), fields.end(), fits) && std::any_of(fields.begin(), fields.end(), isNumber);
}

bool hasWord(std::string_view text, std::initializer_list<std::string_view> words) {
  std::string word;
  for (const char c : lower(text) + ' ') {
    if (c >= 'a' && c <= 'z') {
      word += c;
    } else if (!isAscii(c)) {
      word = "u";
    } else if (std::find(words.begin(), words.end(), word) != words.end()) {
      return true;
    } else {
      word.clear();
    }
  }
  return false;
}

double unitOf(std::string_view title) {
  return hasWord(title, {"ns", "nanosecond", "nanoseconds"})     ? 1
         : hasWord(title, {"us", "microsecond", "microseconds"}) ? 1e3
         : hasWord(title, {"ms", "millisecond", "milliseconds"}) ? 1e6
                                                                 : 1e9;
}

bool isUnit(std::string_view field) {
  return field.empty() || hasWord(field, {"sequence", "s", "second", "ms", "us", "ns", "v", "mv", "volt", "volts"});
}

bool isTitles(const Fields &fields) {
  const auto isChannel = [](std::string_view field) {
    return !isNumber(field) || (field.size() <= 2 && std::all_of(field.begin(), field.end(), isDigit));
  };
  return !fields.empty() && !isNumber(fields.front()) && std::all_of(fields.begin(), fields.end(), isChannel);
}

void splitRow(std::string_view row, char separator, Fields &fields) {
  fields.clear();
  while (!row.empty()) {
    const size_t size = row.find(separator);
    fields.push_back(trimmed(row.substr(0, size)));
    row.remove_prefix(size == std::string_view::npos ? row.size() : size + 1);
  }
}

bool takeInfinity(const char *&at, const char *end, double &volts) {
  const char *p = at + (at < end && *at == '-');
  const char *word = p;
  while (p < end && !isAscii(*p)) {
    p++;
  }
  if (p == word) {
    return false;
  }
  volts = at == word ? HUGE_VAL : -HUGE_VAL;
  at = p;
  return true;
}

}  // namespace line
