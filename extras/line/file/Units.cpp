#include "line/file/Units.h"

#include <algorithm>
#include <cmath>

#include "line/capture/Parsing.h"
#include "sbus/Frame.h"

namespace line {

namespace {

double percentOf(uint16_t raw, const sbus::Range &range) {
  const bool isAbove = (raw > range.centre) == (range.high > range.centre);
  const double side = isAbove ? range.high - range.centre : range.centre - range.low;
  return 100.0 * (raw - range.centre) / side;
}

double exactRawOf(double value, Unit unit, const sbus::Range &range) {
  switch (unit) {
    case Unit::Raw:
      return value;
    case Unit::Us:
      return (value - 880) * 8 / 5;
    case Unit::Percent:
      break;
  }
  const double side = value > 0 ? range.high - range.centre : range.centre - range.low;
  return range.centre + value * side / 100;
}

}  // namespace

double valueOf(uint16_t raw, Unit unit, const sbus::Range &range) {
  return unit == Unit::Raw ? raw : unit == Unit::Us ? raw * 5 / 8.0 + 880 : percentOf(raw, range);
}

std::optional<uint16_t> rawOf(double value, Unit unit, const sbus::Range &range) {
  const double raw = std::round(exactRawOf(value, unit, range));
  const bool isWhole = unit != Unit::Raw || value == raw;
  return isWhole && raw >= 0 && raw <= sbus::ChannelMax ? std::optional<uint16_t>(static_cast<uint16_t>(raw))
                                                        : std::nullopt;
}

bool isRange(unsigned low, unsigned centre, unsigned high) {
  const bool isRising = low < centre && centre < high;
  const bool isFalling = low > centre && centre > high;
  return (isRising || isFalling) && std::max(low, high) <= sbus::ChannelMax;
}

unsigned channelOf(std::string_view text) {
  constexpr unsigned Most = 32;
  unsigned channel = 0;
  const bool is = text.substr(0, 2) == "ch" && text.substr(2, 1) != "0" && parseWhole(text.substr(2), channel);
  return is && channel <= Most ? channel : 0;
}

std::optional<uint16_t> parseValue(const std::string &text, const sbus::Range &range) {
  const auto endsWith = [&text](const std::string &end) {
    return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
  };
  const Unit unit = endsWith("us") ? Unit::Us : endsWith("%") ? Unit::Percent : Unit::Raw;
  const std::string number = text.substr(0, text.size() - (unit == Unit::Us ? 2 : unit == Unit::Percent ? 1 : 0));
  double value = 0;
  const bool isNumber = number.find_first_not_of("0123456789.-+") == std::string::npos &&
                        number.find_first_of("0123456789") != std::string::npos && parseNumber(number, value);
  return isNumber ? rawOf(value, unit, range) : std::nullopt;
}

}  // namespace line
