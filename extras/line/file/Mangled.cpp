#include "line/file/Mangled.h"

#include <algorithm>
#include <cstdint>

#include "sbus/Frame.h"

namespace line {

namespace {

// Returns true if all bytes from 80 on, and more of them than come by chance, are characters of UTF-8.
bool isUtf8(std::string_view bytes) {
  constexpr size_t Enough = 4;
  size_t count = 0;
  for (size_t i = 0; i < bytes.size(); i++) {
    const auto c = static_cast<uint8_t>(bytes[i]);
    const size_t more = c < 0x80 ? 0 : c < 0xE0 ? 1 : c < 0xF0 ? 2 : 3;
    if (more > 0 && i + more < bytes.size()) {
      const auto rest = bytes.substr(i + 1, more);
      if (c < 0xC2 || c > 0xF4 ||
          !std::all_of(rest.begin(), rest.end(), [](char each) { return (each & 0xC0) == 0x80; })) {
        return false;
      }
      count++;
    }
    i += more;
  }
  return count >= Enough;
}

// Returns how often a header follows flags and an end byte, this many bytes after the one before.
size_t headersIn(std::string_view bytes, size_t least, size_t most) {
  size_t count = 0, before = 0;
  for (size_t i = 2; i < bytes.size(); i++) {
    if (bytes[i] == sbus::HeaderByte && sbus::isEndByte(static_cast<uint8_t>(bytes[i - 1])) &&
        sbus::isFlagsByte(static_cast<uint8_t>(bytes[i - 2]))) {
      count += i - before >= least && i - before <= most;
      before = i;
    }
  }
  return count;
}

// Returns true if each 0A follows 0D, and frames are too long.
bool hasCrLf(std::string_view bytes) {
  constexpr size_t MostMore = 6;
  size_t pairs = 0;
  for (size_t i = 1; i < bytes.size(); i++) {
    pairs += bytes[i - 1] == '\r' && bytes[i] == '\n';
  }
  return pairs > 0 && std::count(bytes.begin(), bytes.end(), '\n') == static_cast<std::ptrdiff_t>(pairs) &&
         headersIn(bytes, sbus::FrameSize + 1, sbus::FrameSize + MostMore) > 0;
}

// Returns true if there is no 11 and no 13, and frames are too short.
bool lacksXonXoff(std::string_view bytes) {
  const size_t shorts = headersIn(bytes, sbus::FrameSize - 6, sbus::FrameSize - 1);
  return bytes.find_first_of("\x11\x13") == bytes.npos && shorts >= 3 &&
         10 * shorts > headersIn(bytes, 0, bytes.size());
}

}  // namespace

Mangled::Mangled(std::string_view head) {
  const bool wasUtf8 = isUtf8(head);
  if (wasUtf8 || hasCrLf(head)) {
    isLost = true;
    what = wasUtf8 ? "its bytes went through UTF-8: a program took them for text"
                   : "each 0A became 0D 0A: a program took its bytes for text";
    remedy = "write them to the file as they are";
  } else if (lacksXonXoff(head)) {
    what = "11 and 13 are missing throughout, and frames are too short: they are taken for XON and XOFF";
    remedy = "turn software flow control off in the program that wrote it";
  }
}

}  // namespace line
