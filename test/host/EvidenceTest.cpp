// Files of bytes without times: what is no line has no frame, and what stands between frames costs none.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "line/Observer.h"
#include "line/file/FileHead.h"
#include "line/recording/Words.h"
#include "line/simulation/Random.h"
#include "support/BitByBit.h"
#include "impairment/Settings.h"

namespace {

using Frames = std::vector<Frame>;

Frames flight(line::Random &random) {
  Channels channels{};
  for (size_t i = 0; i < 16; i++) {
    channels[i] = static_cast<uint16_t>(172 + random.below(1640));
  }
  Frames frames(12);
  for (Frame &frame : frames) {
    for (size_t i = 0; i < 4; i++) {
      channels[i] =
          static_cast<uint16_t>(std::clamp<int>(channels[i] + static_cast<int>(random.below(61)) - 30, 172, 1811));
    }
    frame = writeBitByBit(channels);
  }
  return frames;
}

std::string written(const char *form, unsigned value) {
  char text[32];
  std::snprintf(text, sizeof text, form, value);
  return text;
}

// The frames that a file shows; of a wrong file none.
Frames framesIn(const std::string &file) {
  Frames frames;
  const line::FileHead head = line::readFileHead(file.substr(0, line::FileHeadMax), "file");
  const std::unique_ptr<line::LineReader> reader = line::makeReader(head, true);
  if (!reader) {
    return frames;
  }
  line::Observer observer;
  observer.listen([&frames](const line::Stretch &stretch) {
    if (stretch.isFrame()) {
      frames.emplace_back();
      for (size_t i = 0; i < std::min(frames.back().size(), stretch.characters.size()); i++) {
        frames.back()[i] = stretch.characters[i].value;
      }
    }
  });
  std::deque<line::Character> characters;
  for (std::string_view rest = file; !rest.empty();) {
    reader->line(reader->takesBytes() ? std::exchange(rest, std::string_view()) : line::takeLine(rest), characters);
  }
  reader->finish(characters);
  for (const line::Character &each : characters) {
    observer.put(each);
  }
  observer.idleUntil((characters.empty() ? 0 : characters.back().endUs) + line::TailUs);
  observer.finish();
  return frames;
}

}  // namespace

TEST_CASE("numbers that are no line have no frame, however often 0F and 00 are among them") {
  line::Random random(seedOfDay());
  const std::vector<unsigned> values[] = {
      {0, 15, 90, 180}, {0, 1, 2, 14, 15, 16}, {0, 15, 255, 128, 64, 32, 7}, {0, 0, 15, 200}};
  const char *const forms[] = {"%u ", "%u, ", "%02X ", "0x%02x, "};
  const char *const heads[] = {"", "temp ", "angles: "};
  unsigned claimed = 0, texts = 0;
  for (const auto &set : values) {
    for (const char *const form : forms) {
      for (const char *const head : heads) {
        for (int i = 0; i < 4; i++, texts++) {
          std::string text;
          const uint64_t perLine = 1 + random.below(12), lines = 40 + random.below(200);
          for (uint64_t line = 0; line < lines; line++) {
            text += head;
            for (uint64_t k = 0; k < perLine; k++) {
              const bool isOther = random.below(4) == 0;
              text += written(form, isOther ? static_cast<unsigned>(random.below(200))
                                            : set[random.below(static_cast<uint32_t>(set.size()))]);
            }
            text += '\n';
          }
          claimed += !framesIn(text).empty();
        }
      }
    }
  }
  MESSAGE(claimed, " of ", texts, " texts have frames; seed ", seedOfDay());
  CHECK(claimed * 100 <= texts);
}

TEST_CASE("a table that changes in steps has no frame: no radio sends channels at the very ends of their range") {
  std::string text;
  for (const auto &[value, lines] : {std::pair("15", 14), {"128", 4}, {"0", 4}, {"255", 5}, {"0", 13}}) {
    for (int i = 0; i < lines; i++) {
      text += std::string("temp ") + value + "\n";
    }
  }
  CHECK(framesIn(text).empty());
}

TEST_CASE("tables of small numbers, as programs have them, have no frame") {
  line::Random random(seedOfDay() + 1);
  unsigned claimed = 0;
  constexpr unsigned Files = 60;
  for (unsigned i = 0; i < Files; i++) {
    std::string file;
    const uint64_t record = 4 + random.below(40), size = 100 + random.below(50000);
    while (file.size() < size) {
      for (uint64_t k = 0; k < record; k++) {
        const uint64_t kind = (k * 7 + i) % 5;
        file += static_cast<char>(kind < 3 ? random.below(3) * 0 : kind == 3 ? random.below(20) : random.below(256));
      }
    }
    claimed += !framesIn(file).empty();
  }
  MESSAGE(claimed, " of ", Files, " files have frames; seed ", seedOfDay() + 1);
  CHECK(claimed <= 4);
}

TEST_CASE("a table that repeats itself, or ends in what looks like a frame, has none: no radio sends such channels") {
  line::Random random(seedOfDay() + 4);
  unsigned repeated = 0, ended = 0;
  constexpr unsigned Texts = 200;
  for (unsigned i = 0; i < Texts; i++) {
    std::string turn = "15 ", others;
    for (uint64_t k = 1; k < sbus::FrameSize; k++) {
      turn += written("%u ", k < sbus::FlagsIndex ? random.below(32) : 0);
    }
    for (uint64_t k = 0; k < 40; k++) {
      others += written("%u ", random.below(2) == 0 ? 15 : random.below(200));
    }
    const std::string between = others.substr(0, others.find(' ', random.below(60)) + 1);
    std::string text;
    for (int turns = 0; turns < 20; turns++) {
      text += turn + between;
    }
    repeated += !framesIn("temp " + text + '\n').empty();
    ended += !framesIn("angles: " + others + "16\nangles: " + turn + '\n').empty();
  }
  MESSAGE(repeated, " and ", ended, " of ", Texts, " texts have frames; seed ", seedOfDay() + 4);
  CHECK(repeated * 5 <= Texts);
  CHECK(ended * 20 <= Texts);
}

TEST_CASE("a long file without a frame at its beginning is no line, and raw frames may have CR LF between them") {
  line::Random random(seedOfDay() + 3);
  Frames sent = flight(random);
  const auto bytesOf = [&sent](const char *between) {
    std::string bytes;
    for (const Frame &frame : sent) {
      bytes.append(frame.begin(), frame.end());
      bytes += between;
    }
    return bytes;
  };
  CHECK(framesIn(bytesOf("")) == sent);
  const std::string zeros(line::FileHeadMax, '\0'), numbers = [] {
    std::string text;
    while (text.size() < line::FileHeadMax) {
      text += "RX: 1 2 3 4 5 6 7 8 9\n";
    }
    return text;
  }();
  CHECK(framesIn(zeros + '\1' + bytesOf("")).empty());
  CHECK(line::readFileHead(std::string(line::FileHeadMax, '\1'), "file").error.find("have no frame") !=
        std::string::npos);
  std::string others;
  for (int i = 0; i < 600; i++) {
    others += "\1\2";
  }
  CHECK(framesIn(bytesOf("") + others).empty());  // 300 of 1500 bytes are in frames
  CHECK(framesIn(bytesOf("") + others.substr(0, 800)) == sent);
  CHECK(line::readFileHead(numbers, "file").kind == line::FileKind::Wrong);
  for (Frame &frame : sent) {
    std::replace(frame.begin() + 1, frame.end(), uint8_t{'\n'}, uint8_t{'\v'});
    std::replace(frame.begin() + 1, frame.end(), uint8_t{0x0F}, uint8_t{0x1F});
  }
  CHECK(framesIn(bytesOf("\r\n")) == sent);
  sent.resize(1);
  for (const size_t count : {size_t{1}, size_t{5}, size_t{15}}) {  // a single frame, as one is posted
    CHECK(framesIn(bytesOf("") + std::string(count, '\0')) == sent);
  }
  CHECK(framesIn(bytesOf("") + others.substr(0, 50)).empty());
}

TEST_CASE("frames half of whose channels leap are none, unless they fill the file") {
  line::Random random(seedOfDay() + 6);
  std::string bytes;
  for (int i = 0; i < 12; i++) {
    Channels channels{};
    for (size_t k = 0; k < 16; k++) {
      channels[k] = static_cast<uint16_t>(k < 8 ? 172 + random.below(1640) : 992 + k);
    }
    const Frame frame = writeBitByBit(channels);
    bytes.append(frame.begin(), frame.end());
  }
  CHECK(framesIn(bytes).size() == 12);
  CHECK(framesIn(bytes + std::string(150, '\1')).empty());
}

TEST_CASE("rows with times that are 9 ms apart are a sketch's, no samples of a wire") {
  std::string rows = "time,CH1,CH2\n";
  for (int i = 1; i < 40; i++) {
    rows += "0." + std::to_string(1000 + 9 * i) + "," + std::to_string(992 + i) + ",172\n";
  }
  CHECK(line::kindOfText(rows) == line::FileKind::Rows);
}

TEST_CASE("a distance that hardly a frame has is no evidence: what begins within a damaged frame is none") {
  line::Random random(seedOfDay() + 5);
  Frames sent;
  while (sent.size() < 48) {
    for (const Frame &frame : flight(random)) {
      sent.push_back(frame);
      std::replace(sent.back().begin() + 1, sent.back().end(), uint8_t{0x0F}, uint8_t{0x1F});
    }
  }
  sent[20][0] = 0x8F;
  sent[20][4] = sbus::HeaderByte;  // 25 bytes from here look like a frame; they end in the next one
  sent[21][1] = 0;
  std::string bytes;
  for (const Frame &frame : sent) {
    bytes.append(frame.begin(), frame.end());
    bytes.append(2, '\0');
  }
  sent.erase(sent.begin() + 20);
  CHECK(framesIn(bytes) == sent);
}

TEST_CASE("what stands before, between and around frames costs none, in any form") {
  struct Between {
    const char *what;
    size_t before, after;  // bytes of it
  };
  const Between fillers[] = {{"", 0, 0},   {"\r\n", 0, 2},         {"\0", 0, 1},
                             {"\0", 1, 0}, {"\xAA\x55\xAA", 0, 3}, {"\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0", 0, 15}};
  const char *const forms[] = {"%02X ", "%02x", "0x%02X, ", "%u ", "%u, "};
  const char *const heads[] = {"",       "RX: ",   "15:16:17 ", "15:16:17,", "15:16:17; ", "2026-11-24 15:16:16 | ",
                               "16 25 ", "12.345 "};
  line::Random random(seedOfDay() + 2);
  unsigned lost = 0, ways = 0;
  for (const Between &filler : fillers) {
    for (int isRaw = 0; isRaw < 2; isRaw++) {
      for (const char *const form : forms) {
        for (const char *const head : heads) {
          for (const size_t width : {size_t{0}, size_t{16}}) {
            const bool isAgain = isRaw == 1 && (form != forms[0] || head != heads[0] || width > 0);
            const bool isLabelOfPart = width > 0 && *head != '\0';
            // Rows of numbers between commas are a sketch's, and 15, of a clock or a frame, may be either.
            const bool isDoubtful = std::string_view(form) == "%u, " && (width > 0 || *head != '\0');
            const bool isHidden = std::string_view(form) == "%02x" && head[0] == '1';
            if (isAgain || isLabelOfPart || isDoubtful || isHidden) {
              continue;
            }
            const Frames sent = flight(random);
            std::string bytes, text;
            std::vector<size_t> ends;
            for (const Frame &frame : sent) {
              bytes += std::string(filler.what, filler.before);
              bytes.append(frame.begin(), frame.end());
              bytes += std::string(filler.what, filler.after);
              ends.push_back(bytes.size());
            }
            for (size_t at = 0, line = 0; at < bytes.size() && isRaw == 0; line++) {
              const size_t end = width > 0 ? std::min(at + width, bytes.size()) : ends[line];
              text += head;
              for (; at < end; at++) {
                text += written(form, static_cast<uint8_t>(bytes[at]));
              }
              text += '\n';
            }
            ways++;
            const bool isRight = framesIn(isRaw == 1 ? bytes : text) == sent;
            lost += !isRight;
            if (!isRight) {
              MESSAGE("not read: ", std::string(head), std::string(form), " width ", width, ", ", filler.before,
                      " before, ", filler.after, " after, raw ", isRaw);
            }
          }
        }
      }
    }
  }
  MESSAGE(lost, " of ", ways, " ways are not read; seed ", seedOfDay() + 2);
  CHECK(lost == 0);
}
