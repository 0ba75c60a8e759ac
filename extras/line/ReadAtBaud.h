// Recognises frames of S.Bus that a port has read at a common baud rate, 115200 or 57600, 8N1, as terminals do: at
// 100000 baud the header 0F always becomes the same byte, or one of four, and the end of a frame one of a few.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <string_view>

namespace line {

class ReadAtBaud {
 public:
  // Takes the next byte.
  void put(uint8_t byte) {
    for (Rate &rate : _rates) {
      const bool begins = (byte & rate.mask) == rate.first && rate.lasts.find(_last) != rate.lasts.npos;
      rate.since = std::min(rate.since + 1, 100u);
      rate.high += byte >= 0x80;
      if (begins) {
        rate.row = rate.since >= rate.least && rate.since <= rate.most && rate.high >= HighLeast ? rate.row + 1 : 0;
        rate.since = 0;
        rate.high = 0;
        rate.best = std::max(rate.best, rate.row);
      }
    }
    _last = static_cast<char>(byte);
  }

  // Returns the baud rate; 0 if it is none of these, or not known yet.
  unsigned long baud() const {
    const auto found =
        std::find_if(std::begin(_rates), std::end(_rates), [](const Rate &rate) { return rate.best >= RowLeast; });
    return found == std::end(_rates) ? 0 : found->baud;
  }

 private:
  static constexpr unsigned HighLeast = 4;  // a frame is no text
  static constexpr unsigned RowLeast = 8;   // frames, one after the other

  struct Rate {
    unsigned long baud;
    std::string_view lasts;  // the byte before the header, by flags and end byte
    uint8_t first, mask;     // the header's
    unsigned least, most;    // bytes of a frame, of 16 channels or 24
    unsigned since = 100;    // bytes since the newest header
    unsigned high = 0;       // of these, not ASCII
    unsigned row = 0;
    unsigned best = 0;
  };

  Rate _rates[2] = {{115200, {"\x00\x0C\x10\x2C\x4C\x60\x6C\x70\xC0\xC1\xC2\xE0\xE3\xF0", 14}, 0x1F, 0xFF, 20, 45},
                    {57600, "\x20\x22\x24\x26\x44\x46\xE0\xE4\xF0\xF2\xF4\xFC\xFD\xFE\xFF", 0x23, 0x3F, 10, 24}};
  char _last = 0;
};

}  // namespace line
