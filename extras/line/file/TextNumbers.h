// The numbers in a line of text, as people write bytes: what may be one, how they are joined, and which of them belong
// together.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "line/Line.h"
#include "line/recording/Words.h"
#include "sbus/Frame.h"

namespace line {

struct TextByte {
  uint8_t value;
  bool bad;  // marked by !, as in the output of `sbus hex`
};
using TextBytes = std::vector<TextByte>;

// Returns true if these bytes may be a frame of this size.
bool isFrameAt(const TextBytes &bytes, size_t at, size_t size = sbus::FrameSize);

// A number of a line, and what stands before it.
struct TextNumber {
  std::string_view text;
  char sign;        // between it and the number before it: see signOf()
  bool isNegative;  // of signed decimal bytes
  bool isFirst;     // a bracket opens before it
};

using Numbers = std::vector<TextNumber>;

constexpr size_t RunLeast = 4;  // numbers with the same sign between them: fewer are a date or a time

inline bool isOneOf(char c, std::string_view set) { return set.find(c) != set.npos; }

inline bool isLetterOrDigit(char c) { return isDigit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

// Calls take(word, what precedes it) for each word of letters and digits. ! ends a word.
template <typename Take>
void forEachWord(std::string_view text, const Take &take) {
  for (size_t at = 0, before = 0; at < text.size();) {
    const size_t begin = at;
    while (at < text.size() && isLetterOrDigit(text[at])) {
      at++;
    }
    at += at > begin && at < text.size() && text[at] == '!';
    if (at > begin) {
      take(text.substr(begin, at - begin), text.substr(before, begin - before));
      before = at;
    } else {
      at++;
    }
  }
}

// Take the end, or 0x, off a word. Return false if it has none.
bool takeEnd(std::string_view &word, char end);
bool takeMark(std::string_view &word);

// Returns true if bytes may be written like this. 0x and up to 16 digits is an address.
bool isNumber(std::string_view word);

// Reads a number with one digit, or bytes of two digits. Returns false for other words.
bool takeHex(std::string_view word, TextBytes &bytes);

// Returns true if a line has bytes in strings: \x0F, or several in octal, as strace and gdb print them.
bool hasEscapes(std::string_view text);

// Reads the strings in a line; without quotation marks, from the first backslash to the end.
std::string readStrings(std::string_view text, TextBytes &bytes);

// Returns the part of a line that holds its bytes: not a comment, and what is assigned, unless more numbers come
// before.
std::string_view contentOf(std::string_view text, bool &isAssigned);

// Returns all numbers of a line. `areAtEnd`: a number is its last word.
Numbers allNumbers(std::string_view text, bool &areAtEnd);

// Numbers with the same sign between them.
struct Runs {
  Numbers bytes;  // of all runs that are not too short
  Numbers last;   // the last run
};

Runs runsOf(const Numbers &all);

// Returns true if the last numbers are those of a date or a time.
bool endsWithTime(const Numbers &all, const Numbers &last);

// Reads bytes in hexadecimal: 0F E3 03, 0FE303, F E3 3, 0x0F, 0xE3. Returns the first word that is none, or nothing.
std::string parseHex(std::string_view text, TextBytes &bytes);

// Reads such bytes as characters without times. Returns false for other words, and without any.
bool parseHex(std::string_view text, std::vector<Character> &characters);

}  // namespace line
