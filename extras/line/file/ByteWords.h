// Words of a text that stand for bytes: numbers in any base, strings with escapes, characters of od -c.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace line {

struct TextByte {
  uint8_t value;
  bool bad;  // marked by !, as in the output of `sbus hex`
};
using TextBytes = std::vector<TextByte>;

namespace words {

bool isOneOf(char c, const char *set);

bool isSeparator(char c);

bool areAll(std::string_view text, bool (*is)(char));

// Takes 0x, \x, $, &H or h off a hexadecimal number. Returns true if there was one.
bool takeMark(std::string_view &word);

// Takes ! off a byte with an error.
bool takeBad(std::string_view &word);

// Returns true if bytes may be written like this, in some base.
bool isNumber(std::string_view word);

size_t countWords(std::string_view text);

bool areNumbers(std::string_view text);

// Returns the number of bytes that a word of a dump stands for. Words of six octal digits are two.
size_t sizeOf(std::string_view word, std::string_view first);

// Returns true for a word that precedes bytes: a time such as 12:34:56.789, a date, "1)", a prompt, a name.
bool isPrefix(std::string_view word);

// Returns the text from where a list begins: after a bracket that two numbers or more follow, or all of it.
std::string_view listOf(std::string_view text);

// Takes the next list off what follows a list: "], [15, 119]]". Returns nothing if no list follows.
std::string_view takeList(std::string_view &rest);

// Returns the text without blanks around it and without colours.
std::string_view plain(std::string_view text);

// Takes a label, "RX: ", off the text: what precedes a colon and a blank, and is no number.
std::string_view withoutLabel(std::string_view text);

// Takes a number with one digit, or bytes of two digits. Returns false for other words.
bool takeHex(std::string_view word, bool isBad, TextBytes &bytes);

// Reads the strings in a line; without quotation marks, from the first backslash to the end.
std::string readStrings(std::string_view text, TextBytes &bytes);

// Reads a line of od -c: each character in four columns.
std::string readCells(std::string_view text, TextBytes &bytes);

// Calls take(word, column) for each word between separators. Returns false once `take` does. \x begins a word.
template <typename Take>
bool forEachWord(std::string_view text, const Take &take) {
  for (size_t at = 0; at < text.size();) {
    const size_t begin = at;
    while (at < text.size() && !isSeparator(text[at]) && (at == begin || (text[at] != '\\' && text[at - 1] != '!'))) {
      at++;
    }
    if (at > begin && !take(text.substr(begin, at - begin), begin)) {
      return false;
    }
    at += at < text.size() && isSeparator(text[at]);
  }
  return true;
}

}  // namespace words

// Reads bytes in hexadecimal: 0F E3 03, 0FE303, F E3 3, 0x0F, 0xE3. Returns the first word that is none, or nothing.
std::string parseHex(std::string_view text, TextBytes &bytes);

}  // namespace line
