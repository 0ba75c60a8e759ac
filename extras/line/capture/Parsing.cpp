#include "line/capture/Parsing.h"

#include <cmath>

#include "line/recording/WallTime.h"

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

}  // namespace

bool takeNumber(const char *&at, const char *end, double &value, char mark) {
  const char *p = at;
  const bool negative = p < end && *p == '-';
  p += p < end && (*p == '-' || *p == '+') ? 1 : 0;
  uint64_t mantissa = 0;
  int exponent = 0;
  bool any = false;
  bool fraction = false;
  for (; p < end && (isDigit(*p) || ((*p == '.' || *p == mark) && !fraction)); p++) {
    if (!isDigit(*p)) {
      fraction = true;
      continue;
    }
    any = true;
    if (mantissa < 1000000000000000000u / 10) {
      mantissa = mantissa * 10 + static_cast<uint64_t>(*p - '0');
      exponent -= fraction ? 1 : 0;
    } else if (!fraction && exponent < PowerMax) {
      exponent++;
    }
  }
  if (!any) {
    return false;
  }
  if (p < end && (*p == 'e' || *p == 'E')) {
    const char *e = p + 1;
    const bool minus = e < end && *e == '-';
    e += e < end && (*e == '-' || *e == '+') ? 1 : 0;
    int power = 0;
    if (e < end && isDigit(*e)) {
      for (; e < end && isDigit(*e); e++) {
        power = power < 1000 ? power * 10 + (*e - '0') : power;
      }
      exponent += minus ? -power : power;
      p = e;
    }
  }
  if (exponent > PowerMax) {
    return false;
  }
  value = exponent < -PowerMax ? 0 : static_cast<double>(mantissa) * TenTo.of[PowerMax + exponent];
  value = negative ? -value : value;
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
  const std::string unit = lower(trimmed(std::string_view(at, static_cast<size_t>(end - at))));
  const double hertz = unit == "ghz" ? 1e9 : unit == "mhz" ? 1e6 : unit == "khz" ? 1e3 : 1;
  return 1e9 / (number * hertz);
}

bool parseTimestamp(std::string_view word, int64_t &ns) {
  const std::string text(word);
  constexpr int64_t After2100 = 4133980800;  // seconds; 64 bits of ns reach 2262
  int64_t seconds = 0;
  const char *at = takeDate(text.c_str(), seconds);
  if (at == nullptr || seconds < 0 || seconds >= After2100) {
    return false;
  }
  double fraction = 0;
  if (*at == '.') {
    takeNumber(at, text.c_str() + text.size(), fraction);
  }
  constexpr int64_t SecondNs = 1000000000;
  ns = seconds * SecondNs + std::llround(fraction * SecondNs);
  return *at == '\0' || *at == 'Z' || *at == '+' || *at == '-';
}

}  // namespace line
