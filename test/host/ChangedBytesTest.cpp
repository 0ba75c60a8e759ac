// Files whose bytes another program has changed: what happened is named, and no frame is read that nobody sent.
#include <doctest/doctest.h>

#include <algorithm>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "line/Observer.h"
#include "line/file/FileHead.h"
#include "line/simulation/Random.h"
#include "support/BitByBit.h"

namespace {

constexpr size_t Frames = 40;

using Bytes = std::string;

// Sticks that move a little from frame to frame around values that every flight has.
std::vector<Bytes> flight(uint64_t seed) {
  line::Random random(seed);
  Channels channels{};
  for (size_t i = 0; i < 16; i++) {
    channels[i] = static_cast<uint16_t>(172 + random.below(1640));
  }
  std::vector<Bytes> frames;
  while (frames.size() < Frames) {
    for (size_t i = 0; i < 4; i++) {
      channels[i] =
          static_cast<uint16_t>(std::clamp<int>(channels[i] + static_cast<int>(random.below(61)) - 30, 172, 1811));
    }
    const Frame frame = writeBitByBit(channels);
    frames.emplace_back(frame.begin(), frame.end());
  }
  return frames;
}

Bytes replaced(const Bytes &bytes, Bytes (*each)(char)) {
  Bytes changed;
  for (const char c : bytes) {
    changed += each(c);
  }
  return changed;
}

Bytes utf8(char c) {
  const auto value = static_cast<uint8_t>(c);
  return value < 0x80 ? Bytes(1, c)
                      : Bytes{static_cast<char>(0xC0 | value >> 6), static_cast<char>(0x80 | (value & 0x3F))};
}

// The frames that a file of these bytes shows.
std::vector<Bytes> framesIn(const line::FileHead &head, const Bytes &bytes) {
  std::vector<Bytes> frames;
  line::Observer observer;
  observer.listen([&frames](const line::Stretch &stretch) {
    if (stretch.kind == line::Stretch::Kind::Frame || stretch.kind == line::Stretch::Kind::Frame24) {
      frames.emplace_back();
      for (const line::Character &each : stretch.characters) {
        frames.back() += static_cast<char>(each.value);
      }
    }
  });
  std::deque<line::Character> characters;
  const std::unique_ptr<line::LineReader> reader = line::makeReader(head);
  reader->line(bytes, characters);
  reader->finish(characters);
  for (const line::Character &each : characters) {
    observer.put(each);
  }
  observer.finish();
  return frames;
}

}  // namespace

TEST_CASE("of bytes that another program changed, every frame is one that was sent") {
  constexpr uint64_t Files = 300;
  const auto replacement = [](char c) { return c < 0 ? Bytes("\xEF\xBF\xBD") : Bytes(1, c); };
  const auto crLf = [](char c) { return c == '\n' ? Bytes("\r\n") : Bytes(1, c); };
  const auto withoutFlow = [](char c) { return c == 0x11 || c == 0x13 ? Bytes() : Bytes(1, c); };
  // All: each file of 40 frames shows 40. Whole: those that were not changed, and the file is named if it lacks five or
  // more.
  enum class Shown { All, Whole, None };
  const struct {
    const char *what;
    Bytes (*each)(char);
    Shown shown;
    const char *said;
  } rows[] = {
      {"nothing", [](char c) { return Bytes(1, c); }, Shown::All, ""},
      {"UTF-8", utf8, Shown::None, "its bytes went through UTF-8: a program took them for text; write them"},
      {"UTF-8 of ASCII alone", replacement, Shown::None, "its bytes went through UTF-8"},
      {"LF to CR LF", crLf, Shown::None, "each 0A became 0D 0A"},
      {"no XON, no XOFF", withoutFlow, Shown::Whole, "11 and 13 are missing throughout, and frames are too short"},
  };
  for (const auto &row : rows) {
    INFO(std::string(row.what));
    unsigned wrong = 0, fewer = 0, silent = 0;
    for (uint64_t seed = 1; seed <= Files; seed++) {
      const std::vector<Bytes> sent = flight(seed);
      Bytes bytes;
      size_t whole = 0;
      for (const Bytes &each : sent) {
        bytes += replaced(each, row.each);
        whole += replaced(each, row.each) == each;
      }
      const line::FileHead head = line::readFileHead(bytes, "file.bin");
      const bool isNone = head.kind == line::FileKind::Wrong;
      const bool isChanged = whole < Frames && row.shown == Shown::None;  // there may be no LF
      const std::vector<Bytes> got = isNone ? std::vector<Bytes>() : framesIn(head, bytes);
      wrong += std::any_of(got.begin(), got.end(), [&sent](const Bytes &each) {
        return std::find(sent.begin(), sent.end(), each) == sent.end();
      });
      fewer += isNone ? 0 : got.size() != whole;
      const bool mustSay = isChanged || (row.shown == Shown::Whole && whole + 4 < Frames);
      silent += mustSay && (head.error + head.damage).find(row.said) == std::string::npos;
      CHECK((isChanged || !isNone));
      CHECK((row.shown != Shown::All || head.damage.empty()));
    }
    CHECK(wrong == 0);
    CHECK(fewer <= 4);  // of 300 files: frames back to back that look like others, 0F or 2F, from a place within
    CHECK(silent <= 2);
  }
}

TEST_CASE("a few short frames are no flow control, and a few pairs of bytes no UTF-8") {
  const struct { unsigned frames, shorts; } rows[] = {{6, 1}, {40, 3}};
  for (const auto &row : rows) {
    const std::vector<Bytes> sent = flight(row.frames);
    Bytes bytes;
    for (size_t i = 0; i < row.frames; i++) {
      const Bytes frame = replaced(sent[i], [](char c) { return Bytes(1, c == 0x11 || c == 0x13 ? '\x12' : c); });
      bytes += i % 2 == 1 && i < 2 * row.shorts ? frame.substr(0, 5) + frame.substr(6) : frame;
    }
    CAPTURE(row.frames);
    CHECK(line::readFileHead(bytes, "file.bin").damage == "");
  }
  Bytes pairs;
  for (int i = 0; i < 3; i++) {
    pairs += Bytes("\x0F\xC3\xA9") + Bytes(22, '\0');
  }
  CHECK(line::readFileHead(pairs, "file.bin").kind == line::FileKind::Bytes);
}
