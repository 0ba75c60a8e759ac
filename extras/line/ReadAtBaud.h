// Recognises frames of S.Bus that a port has read at a common baud rate, 115200 or 57600, 8N1, as terminals do: at 100000
// baud the header 0F, and the flags and the end byte of a frame without flags, always become the same bytes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>

namespace line {

class ReadAtBaud {
 public:
  // Takes the next byte.
  void put(uint8_t byte) {
    for (Rate &rate : _rates) {
      const bool begins = _last == rate.last && (byte & rate.mask) == rate.first;
      rate.since = std::min(rate.since + 1, 100u);
      if (begins) {
        rate.row = rate.since >= rate.least && rate.since <= rate.most ? rate.row + 1 : 0;
        rate.since = 0;
        rate.best = std::max(rate.best, rate.row);
      }
    }
    _last = byte;
  }

  // Returns the baud rate; 0 if it is none of these, or not known yet.
  unsigned long baud() const {
    const auto found = std::find_if(std::begin(_rates), std::end(_rates), [](const Rate &rate) { return rate.best >= RowLeast; });
    return found == std::end(_rates) ? 0 : found->baud;
  }

 private:
  static constexpr unsigned RowLeast = 8;  // frames, one after the other

  struct Rate {
    unsigned long baud;
    uint8_t last;         // the byte before the header
    uint8_t first, mask;  // the header's
    unsigned least, most;  // bytes of a frame
    unsigned since = 100;  // bytes since the newest header
    unsigned row = 0;
    unsigned best = 0;
  };

  Rate _rates[2] = {{115200, 0x00, 0x1F, 0xFF, 20, 32}, {57600, 0x20, 0x23, 0x3F, 10, 18}};
  uint8_t _last = 0;
};

}  // namespace line
