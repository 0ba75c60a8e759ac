#include "line/file/OtherText.h"

#include <algorithm>

#include "line/file/ByteText.h"
#include "line/file/BytesReader.h"
#include "line/recording/Words.h"

namespace line {

namespace {

constexpr size_t HeadLines = 200;

bool consistsOf(std::string_view word, std::string_view characters) {
  return !word.empty() && word.find_first_not_of(characters) == word.npos;
}

// Returns true if a line is an annotation of sigrok's UART decoder: "uart-1: 0F", "15-16 UART: RX bits: Start bit".
bool isAnnotation(std::string_view line, std::string_view &what) {
  const size_t colon = line.rfind(": ");
  what = colon == line.npos ? "" : withoutBlanks(line.substr(colon + 1));
  const std::string decoder = lower(line.substr(0, std::min(line.size(), colon)));
  return decoder.find("uart") != decoder.npos;
}

// Returns true if there are bits among sigrok's annotations. Bytes alone are read.
bool areBits(std::string_view text) {
  size_t bits = 0, all = 0;
  for (size_t i = 0; i < HeadLines && !text.empty(); i++) {
    std::string_view what;
    const bool is = isAnnotation(takeLine(text), what);
    all += is;
    bits += is && (what == "0" || what == "1" || lower(what).find(" bit") != what.npos);
  }
  return 2 * bits > all && all >= 8;
}

// Returns true if a text begins like a dump, with offset 0.
bool isDump(std::string_view text) {
  const std::string_view word = takeWord(text), offset = word.substr(0, word.find(':'));
  return offset.size() >= 7 && consistsOf(offset, "0");
}

// Returns true if a text is bits, eight and more a word.
bool areDigits(std::string_view text) {
  return consistsOf(text.substr(0, 1000), "01bB ,;\t\r\n") && takeWord(text).size() >= 8;
}

// Returns true for a line of candump on a console: can0  123   [8]  0F E5 03 1F F8 C0 07 3E
bool isCandumpPrint(std::string_view line) {
  std::string_view id = takeWord(line);
  for (std::string_view word = takeWord(line); !word.empty(); id = word, word = takeWord(line)) {
    if (word.size() > 2 && word.front() == '[' && consistsOf(word.substr(1, word.size() - 2), "0123456789")) {
      return word.back() == ']' && (id.size() == 3 || id.size() == 8) && consistsOf(id, "0123456789ABCDEF");
    }
  }
  return false;
}

// (1436509052.249713) can0 123#0FE0
bool isCandump(std::string_view text) {
  std::string_view line = takeLine(text);
  const std::string_view time = takeWord(line);
  takeWord(line);
  return time.size() > 2 && time.front() == '(' && consistsOf(time.substr(1, time.size() - 2), "0123456789.") &&
         takeWord(line).find('#') != line.npos;
}

// :10010000214601360121470136007EFE09D2190140, a programmer's file
bool isIntelHex(std::string_view text) {
  const std::string_view word = takeWord(text);
  return word.size() > 10 && word.front() == ':' && word.size() % 2 == 1 &&
         consistsOf(word.substr(1), "0123456789ABCDEFabcdef");
}

}  // namespace

std::string whatText(std::string_view begin) {
  const std::string_view text = withoutBlanks(begin);
  const bool isSigrok = text.substr(0, 10) == "libsigrok " || text.substr(0, 5) == "META ";
  const bool isPrint = isCandumpPrint(text.substr(0, text.find('\n')));
  const bool hasCharacters = isPrint && text.substr(0, text.find('\n')).find('\'') != text.npos;
  const bool isOtherDump = areDigits(text) || (isDump(text) && !ByteText(text, true).isBytes());
  return isSigrok ? "is sigrok-cli's print of samples: -O vcd -o FILE.vcd makes a capture of them, -A uart=rx-data "
                    "prints a decoder's bytes"
         : isIntelHex(text) ? "is a file of Intel HEX: objcopy -I ihex -O binary FILE.hex FILE.bin makes bytes of it"
         : areBits(text)    ? "is sigrok's annotations of bits: export the bytes alone, with sigrok-cli -A uart=rx-data"
         : isCandump(text)  ? "is candump's log: log2long < FILE prints bytes that are read"
         : hasCharacters
             ? "is candump's print with characters beside the bytes: without -a it prints bytes that are read"
         : isPrint && !BytesReader(begin, true, LineSettings()).hasFrames()
             ? "is candump's print, and no frames are in it: sbus record makes a recording of a receiver's line"
         : isOtherDump ? "is a dump of bits, characters, or numbers that are not hexadecimal: xxd, hexdump -C or od -v "
                         "-t x1 prints one that is read"
                       : "";
}

}  // namespace line
