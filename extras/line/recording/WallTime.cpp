#include "line/recording/WallTime.h"

#include <cstdio>
#include <ctime>

namespace line {

namespace {

constexpr int64_t SecondUs = 1000000;

// Returns the days since 1970. Years begin in March here, so that the leap day is the last one.
int64_t daysSince1970(int year, int month, int day) {
  const int y = month < 3 ? year - 1 : year;
  return int64_t{365} * y + y / 4 - y / 100 + y / 400 + (153 * ((month + 9) % 12) + 2) / 5 + day - 719469;
}

}  // namespace

std::string wallTime(int64_t us) {
  const int64_t second = (us >= 0 ? us : us - SecondUs + 1) / SecondUs;
  const std::time_t time = second;
  char date[32];
  std::strftime(date, sizeof date, "%Y-%m-%dT%H:%M:%S", std::gmtime(&time));
  char text[48];
  std::snprintf(text, sizeof text, "%s.%06uZ", date, static_cast<unsigned>(us - second * SecondUs));
  return text;
}

bool parseWallTime(std::string_view text, int64_t &us) {
  int year, month, day, hour, minute, second, fraction, size = 0;
  std::sscanf(std::string(text).c_str(), "%4d-%2d-%2dT%2d:%2d:%2d.%6dZ%n", &year, &month, &day, &hour, &minute, &second,
              &fraction, &size);
  if (size != 27 || text.size() != 27 || month < 1 || month > 12) {
    return false;
  }
  us = (((daysSince1970(year, month, day) * 24 + hour) * 60 + minute) * 60 + second) * SecondUs + fraction;
  return true;
}

}  // namespace line
