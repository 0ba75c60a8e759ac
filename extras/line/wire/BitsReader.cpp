#include "BitsReader.h"

#include "Text.h"

namespace line {

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
        _sink.level(0, -BitNs, !high);  // idle: the first bit is a start bit
      }
      if (!_begun || high != _high) {
        _sink.level(0, _endNs, high);
      }
      _begun = true;
      _high = high;
      _endNs += BitNs;
    }
  }
  return {};
}

}  // namespace line
