#include "line/capture/BitsReader.h"

#include <cmath>

#include "line/capture/Parsing.h"

namespace line {

BitsReader::BitsReader(LevelSink &sink, double periodNs)
    : CaptureReader(sink), _bitNs(periodNs > 0 ? periodNs : 10000) {
  _periodNs = periodNs;
}

std::string BitsReader::format() const {
  return _periodNs > 0 ? "bits" : "bits, 10 us each";
}

std::string BitsReader::put(std::string_view lines) {
  while (!lines.empty()) {
    std::string_view line = takeLine(lines);
    _lines++;
    line = line.substr(0, line.find('#'));
    for (const char c : line) {
      if (isBlank(c)) {
        continue;
      }
      if (c != '0' && c != '1') {
        return quoted(std::string_view(&c, 1)) + " is not a bit: 0 or 1 is expected";
      }
      if (_endNs >= CaptureTimeMaxNs) {
        return "there are more bits than a year has";
      }
      const bool high = c == '1';
      if (!_begun) {
        _sink.signals({"bits"});
        _sink.level(0, -std::llround(_bitNs), !high);  // idle: the first bit is a start bit
      }
      if (!_begun || high != _high) {
        _sink.level(0, _endNs, high);
      }
      _begun = true;
      _high = high;
      _endNs = std::llround(static_cast<double>(++_bits) * _bitNs);
    }
  }
  return {};
}

}  // namespace line
