// Recognises frames of S.Bus that a port has read at a common baud rate, 115200 or 57600, 8N1, as terminals do: at
// 100000 baud a header always becomes the same byte, or one of four, and the end of a frame one of a few.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <iterator>
#include <string>
#include <string_view>

namespace line {

class ReadAtBaud {
 public:
  // Takes the next byte.
  void put(uint8_t byte) {
    _at++;
    _noText += byte >= 0x7F || (byte < ' ' && byte != '\t' && byte != '\n' && byte != '\r');
    for (Rate &rate : _rates) {
      if (rate.headers.find(static_cast<char>(byte & rate.mask)) != rate.headers.npos &&
          rate.lasts.find(_last) != rate.lasts.npos) {
        takeHeader(rate);
      }
    }
    _last = static_cast<char>(byte);
  }

  // Returns the baud rate; 0 if it is none of these, or not known yet.
  unsigned long baud() const {
    const auto found = std::find_if(std::begin(_rates), std::end(_rates), [this](const Rate &rate) {
      return rate.best >= FramesLeast && 2 * rate.most * rate.frames >= _at;
    });
    return found == std::end(_rates) ? 0 : found->baud;
  }

  // Returns the finding and the remedy, as sentences.
  static std::string finding(unsigned long baud) {
    return "Wrong baud rate: these are frames of S.Bus that a port has read at " + std::to_string(baud) + " baud.";
  }
  static constexpr const char *Remedy =
      "Read the port with sbus, which sets 100000 baud, 8E2: a terminal program often cannot.";

 private:
  static constexpr unsigned NoTextLeast = 4;   // bytes of a frame that no text has
  static constexpr unsigned FramesLeast = 10;  // one after the other
  static constexpr unsigned ApartMost = 150;   // bytes from a header to one that counts: two frames and telemetry

  // What may be a header; the payload has some.
  struct Header {
    uint64_t at;
    uint64_t noText;  // bytes that no text has, up to it
    unsigned frames;  // one after the other, up to it
  };

  struct Rate {
    unsigned long baud;
    std::string_view lasts;    // the byte before a header, by flags and end byte
    std::string_view headers;  // 0F and 2F
    uint8_t mask;              // of their bits
    unsigned least, most;      // bytes of a frame, of 16 channels or 24
    unsigned best = 0;         // frames one after the other, at most
    uint64_t frames = 0;       // in all
    std::deque<Header> newest{};
  };

  void takeHeader(Rate &rate) {
    while (!rate.newest.empty() && _at - rate.newest.front().at > ApartMost) {
      rate.newest.pop_front();
    }
    Header header = {_at, _noText, 0};
    bool ends = false;
    for (const Header &each : rate.newest) {
      const uint64_t size = _at - each.at;
      const bool isFrame = size >= rate.least && size <= rate.most && _noText - each.noText >= NoTextLeast;
      const unsigned before = isFrame ? each.frames + 1 : size > rate.most && each.frames > 0 ? each.frames - 1 : 0;
      header.frames = std::max(header.frames, before);
      ends = ends || isFrame;
    }
    rate.frames += ends;
    rate.best = std::max(rate.best, header.frames);
    rate.newest.push_back(header);
  }

  Rate _rates[2] = {
      {115200, {"\x00\x0C\x10\x1C\x2C\x4C\x60\x6C\x70\xC0\xC1\xC2\xE0\xE3\xF0", 15}, "\x1F\x5F", 0xFF, 20, 45},
      {57600, "\x20\x22\x24\x26\x44\x46\xD3\xE0\xE4\xF0\xF2\xF4\xFC\xFD\xFE\xFF", "\x23\x37", 0x3F, 10, 24}};
  uint64_t _at = 0;      // bytes
  uint64_t _noText = 0;  // of these, none of a text's
  char _last = 0;
};

}  // namespace line
