#include "line/recording/WallTime.h"

#include <cstdio>

namespace line {

namespace {

constexpr int64_t DayS = 86400;
constexpr int64_t SecondUs = 1000000;
constexpr int64_t DaysOf400Years = 146097;
constexpr int64_t From0000To1970 = 719468;  // days, from 1 March of year 0 on

struct Date {
  int64_t year;
  unsigned month;  // 1..12
  unsigned day;    // 1..31
};

// The algorithms of Howard Hinnant, "chrono-Compatible Low-Level Date Algorithms": a year begins in March.
Date dateOf(int64_t days) {
  days += From0000To1970;
  const int64_t era = (days >= 0 ? days : days - DaysOf400Years + 1) / DaysOf400Years;
  const auto dayOfEra = static_cast<unsigned>(days - era * DaysOf400Years);
  const unsigned yearOfEra = (dayOfEra - dayOfEra / 1460 + dayOfEra / 36524 - dayOfEra / 146096) / 365;
  const unsigned dayOfYear = dayOfEra - (365 * yearOfEra + yearOfEra / 4 - yearOfEra / 100);
  const unsigned fromMarch = (5 * dayOfYear + 2) / 153;
  const unsigned month = fromMarch < 10 ? fromMarch + 3 : fromMarch - 9;
  return {yearOfEra + era * 400 + (month <= 2), month, dayOfYear - (153 * fromMarch + 2) / 5 + 1};
}

int64_t daysOf(const Date &date) {
  const int64_t year = date.year - (date.month <= 2);
  const int64_t era = (year >= 0 ? year : year - 399) / 400;
  const auto yearOfEra = static_cast<unsigned>(year - era * 400);
  const unsigned dayOfYear = (153 * (date.month > 2 ? date.month - 3 : date.month + 9) + 2) / 5 + date.day - 1;
  const unsigned dayOfEra = yearOfEra * 365 + yearOfEra / 4 - yearOfEra / 100 + dayOfYear;
  return era * DaysOf400Years + static_cast<int64_t>(dayOfEra) - From0000To1970;
}

// Takes `digits` digits off the text. Returns false if there are others.
bool takeDigits(std::string_view &text, size_t digits, unsigned &value) {
  value = 0;
  for (size_t i = 0; i < digits; i++) {
    if (i >= text.size() || text[i] < '0' || text[i] > '9') {
      return false;
    }
    value = value * 10 + static_cast<unsigned>(text[i] - '0');
  }
  text.remove_prefix(digits);
  return true;
}

bool takeMark(std::string_view &text, char mark) {
  const bool is = !text.empty() && text.front() == mark;
  text.remove_prefix(is ? 1 : 0);
  return is;
}

}  // namespace

std::string wallTime(int64_t us) {
  const int64_t second = (us >= 0 ? us : us - SecondUs + 1) / SecondUs;
  const int64_t days = (second >= 0 ? second : second - DayS + 1) / DayS;
  const Date date = dateOf(days);
  const auto inDay = static_cast<unsigned>(second - days * DayS);
  char text[64];
  std::snprintf(text, sizeof text, "%04lld-%02u-%02uT%02u:%02u:%02u.%06uZ", static_cast<long long>(date.year),
                date.month, date.day, inDay / 3600, inDay / 60 % 60, inDay % 60,
                static_cast<unsigned>(us - second * SecondUs));
  return text;
}

bool parseWallTime(std::string_view text, int64_t &us) {
  unsigned year = 0, month = 0, day = 0, hour = 0, minute = 0, second = 0;
  const bool isTime = takeDigits(text, 4, year) && takeMark(text, '-') && takeDigits(text, 2, month) &&
                      takeMark(text, '-') && takeDigits(text, 2, day) && takeMark(text, 'T') &&
                      takeDigits(text, 2, hour) && takeMark(text, ':') && takeDigits(text, 2, minute) &&
                      takeMark(text, ':') && takeDigits(text, 2, second);
  if (!isTime || month < 1 || month > 12 || day < 1 || day > 31 || hour > 23 || minute > 59 || second > 60) {
    return false;
  }
  int64_t fraction = 0;
  int64_t weight = SecondUs / 10;
  bool isWhole = true;
  if (takeMark(text, '.')) {
    isWhole = false;
    for (unsigned digit = 0; takeDigits(text, 1, digit); weight /= 10) {
      fraction += weight * digit;
      isWhole = true;
    }
  }
  us = (daysOf({year, month, day}) * DayS + hour * 3600 + minute * 60 + second) * SecondUs + fraction;
  return isWhole && text == "Z";
}

}  // namespace line
