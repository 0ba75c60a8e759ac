#include "line/capture/Parsing.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace line {

namespace {

constexpr int PowerMax = 40;  // powers of ten: no measurement needs more

struct Powers {
  double of[2 * PowerMax + 1];
  constexpr Powers() : of() {
    double up = 1;
    double down = 1;
    for (int i = 0; i <= PowerMax; i++, up *= 10, down /= 10) {
      of[PowerMax + i] = up;
      of[PowerMax - i] = down;
    }
  }
};
constexpr Powers TenTo;

// Takes a sign off the front. Returns true for a minus.
bool takeSign(const char *&at, const char *end) {
  const bool isMinus = at < end && *at == '-';
  at += isMinus || (at < end && *at == '+') ? 1 : 0;
  return isMinus;
}

// Appends digits to `value`. Returns how many more there are than it can hold.
int64_t takeDigits(const char *&at, const char *end, uint64_t &value) {
  constexpr uint64_t Most = 100000000000000000;
  int64_t left = 0;
  for (; at < end && isDigit(*at); at++) {
    if (value < Most) {
      value = value * 10 + static_cast<uint64_t>(*at - '0');
    } else {
      left++;
    }
  }
  return left;
}

}  // namespace

bool takeNumber(const char *&at, const char *end, double &value, char mark) {
  const char *p = at;
  const bool isNegative = takeSign(p, end);
  const char *digits = p;
  uint64_t mantissa = 0;
  int64_t exponent = takeDigits(p, end, mantissa);
  bool any = p > digits;
  if (p < end && (*p == '.' || *p == mark)) {
    digits = ++p;
    exponent += takeDigits(p, end, mantissa);
    exponent -= p - digits;
    any = any || p > digits;
  }
  if (any && p < end && (*p == 'e' || *p == 'E')) {
    const char *e = p + 1;
    const bool isBelow1 = takeSign(e, end);
    digits = e;
    uint64_t power = 0;
    takeDigits(e, end, power);
    if (e > digits) {
      const auto most = static_cast<int64_t>(std::min<uint64_t>(power, 1000));
      exponent += isBelow1 ? -most : most;
      p = e;
    }
  }
  if (!any || exponent > PowerMax) {
    return false;
  }
  value = exponent < -PowerMax ? 0 : static_cast<double>(mantissa) * TenTo.of[PowerMax + exponent];
  value = isNegative ? -value : value;
  at = p;
  return true;
}

bool parseNumber(std::string_view word, double &value, char mark) {
  const char *at = word.data();
  const char *end = at + word.size();
  return takeNumber(at, end, value, mark) && at == end;
}

double periodOf(std::string_view rate) {
  const char *at = rate.data();
  const char *end = at + rate.size();
  double number = 0;
  if (!takeNumber(at, end, number) || number <= 0) {
    return 0;
  }
  constexpr std::pair<std::string_view, double> Units[] = {{"", 1},        {"hz", 1},      {"khz", 1e3},
                                                           {"mhz", 1e6},   {"ghz", 1e9},   {"sa/s", 1},
                                                           {"ksa/s", 1e3}, {"msa/s", 1e6}, {"gsa/s", 1e9}};
  const std::string unit = lower(trimmed(std::string_view(at, static_cast<size_t>(end - at))));
  const auto *const known =
      std::find_if(std::begin(Units), std::end(Units), [&unit](const auto &each) { return each.first == unit; });
  return known == std::end(Units) ? 0 : 1e9 / (number * known->second);
}

}  // namespace line
