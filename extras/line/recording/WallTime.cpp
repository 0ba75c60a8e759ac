#include "line/recording/WallTime.h"

#include <cstdio>
#include <ctime>

namespace line {

namespace {

constexpr int64_t SecondUs = 1000000;
constexpr size_t DateSize = 19;  // "2026-11-24T15:16:18"

}  // namespace

const char *takeDate(const char *text, int64_t &seconds) {
  std::tm calendar{};
  const char *const end = strptime(text, "%Y-%m-%dT%H:%M:%S", &calendar);
  seconds = end == nullptr ? 0 : timegm(&calendar);
  return end;
}

std::string wallTime(int64_t us) {
  const int64_t second = (us >= 0 ? us : us - SecondUs + 1) / SecondUs;
  const std::time_t time = second;
  std::tm calendar{};
  gmtime_r(&time, &calendar);
  char date[32];
  std::strftime(date, sizeof date, "%Y-%m-%dT%H:%M:%S", &calendar);
  char text[48];
  std::snprintf(text, sizeof text, "%s.%06uZ", date, static_cast<unsigned>(us - second * SecondUs));
  return text;
}

// Each field of the date has all its digits, as wallTime() writes them.
bool parseWallTime(std::string_view text, int64_t &us) {
  const std::string date(text.substr(0, DateSize));
  int64_t seconds = 0;
  const char *const end = takeDate(date.c_str(), seconds);
  if (end != date.c_str() + DateSize || date.find_first_of(" \t") != std::string::npos) {
    return false;
  }
  text.remove_prefix(DateSize);
  us = seconds * SecondUs;
  if (!text.empty() && text.front() == '.') {
    text.remove_prefix(1);
    const size_t digits = text.find_first_not_of("0123456789");
    for (size_t i = 0, weight = SecondUs / 10; i < digits && i < text.size(); i++, weight /= 10) {
      us += static_cast<int64_t>(weight) * (text[i] - '0');
    }
    text.remove_prefix(digits == 0 || digits == std::string_view::npos ? text.size() : digits);
  }
  return text == "Z";
}

}  // namespace line
