#include "line/recording/Recording.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "line/recording/CsvRows.h"
#include "line/recording/WallTime.h"
#include "line/recording/Words.h"

namespace line {

namespace {

// Returns true for a line of column names that begins with a channel: "CH1,CH2".
bool beginsWithChannel(std::string_view text) {
  const std::string_view first = text.substr(0, text.find_first_of(",;\t\r\n"));
  return first.size() > 2 && first.size() < text.size() && lower(first.substr(0, 2)) == "ch" &&
         std::all_of(first.begin() + 2, first.end(), isDigit);
}

}  // namespace

bool hasTimeColumn(std::string_view text) {
  const std::string_view first = text.substr(0, text.find_first_of(",;\t"));
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
    settings.format.stopBits = comment.find("8E1", end) != std::string::npos ? 1 : 2;
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

}  // namespace line
