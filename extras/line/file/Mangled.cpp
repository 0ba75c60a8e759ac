#include "line/file/Mangled.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "line/Observer.h"

namespace line {

namespace {

using Counts = std::array<size_t, 256>;

Counts countsOf(std::string_view bytes) {
  Counts counts{};
  for (const char c : bytes) {
    counts[static_cast<uint8_t>(c)]++;
  }
  return counts;
}

// What the bytes have in UTF-8: characters up to FF, which stand for a byte, other ones, and what is not UTF-8.
struct Utf8 {
  size_t bytes = 0;
  size_t others = 0;
  size_t wrong = 0;

  explicit Utf8(std::string_view text) {
    for (size_t i = 0; i < text.size(); i++) {
      const auto c = static_cast<uint8_t>(text[i]);
      const size_t more = c < 0x80 ? 0 : c < 0xC2 ? SIZE_MAX : c < 0xE0 ? 1 : c < 0xF0 ? 2 : c < 0xF5 ? 3 : SIZE_MAX;
      if (more == 0 || (more != SIZE_MAX && i + more >= text.size())) {
        continue;
      }
      bool isValid = more != SIZE_MAX;
      for (size_t at = 1; isValid && at <= more; at++) {
        isValid = (static_cast<uint8_t>(text[i + at]) & 0xC0) == 0x80;
      }
      (!isValid ? wrong : c <= 0xC3 ? bytes : others)++;
      i += isValid ? more : 0;
    }
  }
};

// Returns how many frames are in bytes that follow each other directly, and how many bytes belong to none.
std::pair<unsigned long, unsigned long> read(std::string_view bytes) {
  Observer observer;
  Character character;
  for (const char c : bytes) {
    character.endUs += CharacterUs;
    character.value = static_cast<uint8_t>(c);
    observer.put(character);
  }
  observer.finish();
  return {observer.counters().frames, observer.discardedBytes()};
}

// Returns how often a header follows flags and an end byte, this many bytes after the one before.
unsigned long headersIn(std::string_view bytes, size_t least, size_t most) {
  unsigned long count = 0;
  size_t before = 0;
  for (size_t i = 1; i < bytes.size(); i++) {
    const bool begins = bytes[i] == sbus::HeaderByte && sbus::isEndByte(static_cast<uint8_t>(bytes[i - 1])) &&
                        sbus::isFlagsByte(static_cast<uint8_t>(bytes[i > 1 ? i - 2 : 0]));
    count += begins && i - before >= least && i - before <= most;
    before = begins ? i : before;
  }
  return count;
}

}  // namespace

Mangled::Mangled(std::string_view head) {
  constexpr size_t Enough = 8;  // of what does not come by chance
  const Counts counts = countsOf(head);
  const size_t high = std::accumulate(counts.begin() + 0x80, counts.end(), size_t{0});
  const Utf8 utf8(head);
  if (high >= Enough && utf8.wrong == 0 && utf8.bytes + utf8.others >= Enough / 2) {
    _isLost = utf8.others > 0;
    _change = _isLost ? Change::None : Change::Utf8;
    _what = _isLost ? "its bytes went through UTF-8, and those from 80 up are lost: a program took them for text; write "
                      "them to the file as they are"
                    : "its bytes went through UTF-8, which is undone: a program took them for text";
    return;
  }
  const auto [frames, discarded] = read(head);
  const unsigned long likely = std::max(frames, headersIn(head, sbus::FrameSize, sbus::FrameSize));
  if (high == 0 && likely >= 2 && head.size() - counts[0] - counts[sbus::HeaderByte] > likely * Enough) {
    _isLost = true;
    _what = "no byte is above 7F: bit 7 was stripped, and the channels are wrong; set the port of the program that wrote "
            "it to 8 data bits";
    return;
  }
  size_t pairs = 0;
  for (size_t i = 1; i < head.size(); i++) {
    pairs += head[i - 1] == '\r' && head[i] == '\n';
  }
  if (pairs >= 1 && pairs == counts['\n']) {
    _change = Change::CrLf;
    std::string undone;
    undo(head, undone);
    _held = 0;
    const auto [better, left] = read(undone);
    if (better >= frames && left < discarded) {
      _what = "each 0A became 0D 0A, which is undone: a program took the bytes for text";
      return;
    }
    _change = Change::None;
  }
  constexpr uint8_t Xon = 0x11, Xoff = 0x13;
  const unsigned long shorts = headersIn(head, sbus::FrameSize - 6, sbus::FrameSize - 1);
  if (counts[Xon] + counts[Xoff] == 0 && shorts >= 3 && 10 * shorts > frames) {
    _what = "11 and 13 are missing throughout, and frames are too short: they are taken for XON and XOFF; turn software "
            "flow control off in the program that wrote it";
  }
}

void Mangled::undo(std::string_view bytes, std::string &undone) {
  if (_change == Change::None) {
    undone += bytes;
    return;
  }
  for (const char c : bytes) {
    const auto value = static_cast<uint8_t>(c);
    if (_change == Change::Utf8 && value >= 0xC2) {
      _held = value;
      continue;
    }
    if (_change == Change::CrLf && _held == '\r' && value != '\n') {
      undone += '\r';
    }
    if (_change == Change::Utf8 || value != '\r') {
      undone += static_cast<char>(_held == 0xC3 && value >= 0x80 ? value + 0x40 : value);
    }
    _held = _change == Change::CrLf && value == '\r' ? value : 0;
  }
}

}  // namespace line
