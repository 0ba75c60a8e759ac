#include "line/recording/WallTime.h"

#include <cstdio>
#include <ctime>

#include "line/recording/Words.h"

namespace line {

namespace {

constexpr int64_t SecondUs = 1000000;
constexpr std::string_view Form = "0000-00-00T00:00:00";

// Returns the days since 1970. Years begin in March here, so that the leap day is the last one.
int64_t daysSince1970(int year, int month, int day) {
  const int y = month < 3 ? year - 1 : year;
  return int64_t{365} * y + y / 4 - y / 100 + y / 400 + (153 * ((month + 9) % 12) + 2) / 5 + day - 719469;
}

}  // namespace

const char *takeDate(const char *text, int64_t &seconds) {
  int fields[6] = {};
  int *field = fields;
  for (const char form : Form) {
    if (form == '0' ? !isDigit(*text) : *text != form) {
      return nullptr;
    }
    form == '0' ? *field = *field * 10 + (*text - '0') : *++field;
    text++;
  }
  const auto [year, month, day, hour, minute, second] = fields;
  seconds = ((daysSince1970(year, month, day) * 24 + hour) * 60 + minute) * 60 + second;
  return month >= 1 && month <= 12 && day >= 1 && day <= 31 && hour < 24 && minute < 60 && second <= 60 ? text
                                                                                                        : nullptr;
}

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
  const std::string date(text.substr(0, Form.size()));
  int64_t seconds = 0;
  if (takeDate(date.c_str(), seconds) == nullptr) {
    return false;
  }
  text.remove_prefix(Form.size());
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
