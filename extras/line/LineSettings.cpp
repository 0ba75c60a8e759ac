#include "line/LineSettings.h"

#include <algorithm>

namespace line {

bool isOdd(unsigned bits) {
  bool odd = false;
  for (; bits != 0; bits &= bits - 1) {
    odd = !odd;
  }
  return odd;
}

uint32_t LineSettings::bitNs() const {
  constexpr unsigned long SecondNs = 1000000000;
  return static_cast<uint32_t>(SecondNs / std::clamp(baud, 1ul, SecondNs));
}

std::string mismatch(const LineSettings &port, const LineSettings &line) {
  std::string names;
  const auto compare = [&names](bool same, const char *name) {
    names += same ? "" : names.empty() ? name : std::string(", ") + name;
  };
  compare(port.baud == line.baud, "baud rate");
  compare(port.format == line.format, "format");
  compare(line.polarity == Polarity::Either || port.polarity == line.polarity, "polarity");
  return names;
}

std::string text(const LineSettings &settings) {
  const Format &format = settings.format;
  const char parity[] = {'N', 'E', 'O'};
  return std::to_string(settings.baud) + " baud, " + std::to_string(format.dataBits) +
         parity[static_cast<int>(format.parity)] + std::to_string(format.stopBits) +
         (settings.polarity == Polarity::Inverted     ? ", inverted"
          : settings.polarity == Polarity::Uninverted ? ", not inverted"
                                                      : "");
}

}  // namespace line
