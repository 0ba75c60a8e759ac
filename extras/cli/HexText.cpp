#include "cli/HexText.h"

#include <algorithm>
#include <cstring>

namespace tool {

namespace {

bool isSeparator(char letter) {
  return letter == '\0' || std::strchr(" \t\r\n,;:-{}", letter) != nullptr;
}

bool isByte(const std::string &digits, bool alone) {
  return digits.find_first_not_of("0123456789ABCDEFabcdef") == std::string::npos && digits.size() == (alone ? 1 : 2);
}

// Takes one word: a byte with one digit, or bytes with two digits each; 0x before and ! after are allowed. Returns
// false if the word is not hexadecimal.
bool takeWord(const std::string &word, HexText &text) {
  const size_t begin = word.rfind("0x", 0) == 0 || word.rfind("0X", 0) == 0 ? 2 : 0;
  const size_t end = word.size() - (word.back() == '!' ? 1 : 0);
  for (size_t i = begin; i == begin || i < end; i += 2) {
    const std::string digits = i < end ? word.substr(i, std::min<size_t>(2, end - i)) : "";
    if (!isByte(digits, end - begin == 1)) {
      text.wrong = digits.empty() ? word : digits;
      return false;
    }
    text.bytes.push_back({static_cast<uint8_t>(std::stoul(digits, nullptr, 16)), false});
  }
  text.bytes.back().bad = end < word.size();
  return true;
}

}  // namespace

HexText parseHex(std::string_view input) {
  HexText text;
  std::string word;
  for (size_t i = 0; i <= input.size(); i++) {
    const char letter = i < input.size() ? input[i] : ' ';
    if (!isSeparator(letter)) {
      word += letter;
    }
    if ((isSeparator(letter) || letter == '!') && !word.empty()) {
      if (!takeWord(word, text)) {
        break;
      }
      word.clear();
    }
  }
  return text;
}

}  // namespace tool
