#include "line/file/ByteWords.h"

#include <algorithm>
#include <cstring>

#include "line/recording/Words.h"

namespace line {
namespace words {

namespace {

bool isHexDigit(char c) {
  return isDigit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
}

// Reads the character after a backslash, as Python, C and JavaScript write it. Returns false for others.
bool takeEscape(std::string_view text, size_t &at, uint8_t &value) {
  constexpr std::string_view Letters = "abfnrtv\\'\"";
  constexpr std::string_view Values = "\a\b\f\n\r\t\v\\'\"";
  const char letter = at < text.size() ? text[at] : '\0';
  if (letter == 'x' || letter == 'u') {
    const size_t digits = letter == 'x' ? 2 : 4;
    at += digits + 1;
    return at <= text.size() && parseWhole(text.substr(at - digits, digits), value, 16);
  }
  size_t digits = 0;
  while (digits < 3 && at + digits < text.size() && text[at + digits] >= '0' && text[at + digits] <= '7') {
    digits++;
  }
  if (digits > 0) {
    at += digits;
    return parseWhole(text.substr(at - digits, digits), value, 8);
  }
  const size_t known = Letters.find(letter);
  value = known == std::string_view::npos ? uint8_t{0} : static_cast<uint8_t>(Values[known]);
  at++;
  return known != std::string_view::npos;
}

}  // namespace

bool isOneOf(char c, const char *set) {
  return c != '\0' && std::strchr(set, c) != nullptr;
}

bool isSeparator(char c) {
  return isOneOf(c, " \t\r,;:|{}[]()<>'\"`/+-_.=%");
}

bool areAll(std::string_view text, bool (*is)(char)) {
  return !text.empty() && std::all_of(text.begin(), text.end(), is);
}

bool takeMark(std::string_view &word) {
  for (const std::string_view mark : {"0x", "0X", "\\x", "&H", "$"}) {
    if (word.size() > mark.size() && word.substr(0, mark.size()) == mark) {
      word.remove_prefix(mark.size());
      return true;
    }
  }
  const bool hasEnd = word.size() == 3 && (word.back() == 'h' || word.back() == 'H');
  word.remove_suffix(hasEnd ? 1 : 0);
  return hasEnd;
}

bool takeBad(std::string_view &word) {
  const bool isBad = word.size() > 1 && word.back() == '!';
  word.remove_suffix(isBad ? 1 : 0);
  return isBad;
}

bool isNumber(std::string_view word) {
  takeBad(word);
  takeMark(word);
  return areAll(word, isHexDigit) && (word.size() < 4 || word.size() % 2 == 0);
}

size_t countWords(std::string_view text) {
  size_t count = 0;
  forEachWord(text, [&count](std::string_view, size_t) { return ++count > 0; });
  return count;
}

bool areNumbers(std::string_view text) {
  return forEachWord(text, [](std::string_view word, size_t) { return isNumber(word); });
}

size_t sizeOf(std::string_view word, std::string_view first) {
  takeMark(word);
  takeMark(first);
  const bool isBinary = word.size() == 8 && word.find_first_not_of("01") == std::string_view::npos;
  const bool hasWords = first.size() >= 4 && !isBinary;
  return hasWords && first.size() == 6 ? 2 : hasWords ? word.size() / 2 : 1;
}

bool isPrefix(std::string_view word) {
  const auto count = [word](char c) { return std::count(word.begin(), word.end(), c); };
  word = withoutBlanks(withoutBlanks(word, '['), ']');
  const size_t first = word.find_first_of(":.-/");
  const bool isTime = count(':') == 2 && first <= 2 && word.size() >= 7;
  const bool isDate = word.size() == 10 && (count('-') == 2 || count('.') == 2 || count('/') == 2);
  const bool isSeconds = count('.') == 1 && first > 0 && first + 1 < word.size() && isDigit(word.back());
  const bool isItem = !word.empty() && isOneOf(word.back(), ")>.") && word.find_first_of("(<") == std::string_view::npos;
  return isTime || isDate || isSeconds || isItem || countWords(word) == 0 || !areNumbers(word);
}

std::string_view listOf(std::string_view text) {
  for (size_t at = text.find_first_of("[({<"); at != std::string_view::npos; at = text.find_first_of("[({<", at + 1)) {
    const std::string_view rest = text.substr(at + 1);
    std::string_view list = withoutBlanks(rest.substr(0, rest.find_first_of("[]{}()<>")));
    const std::string_view begin = list;
    for (std::string_view next = list; !takeWord(next).empty() && isPrefix(list.substr(0, list.find(' ')));) {
      list = next;  // <Buffer 0f ...>
    }
    if (begin.find_first_of(":.") == std::string_view::npos && list.find_first_of(", ") != std::string_view::npos &&
        countWords(list) > 1 && areNumbers(list)) {
      return list;
    }
  }
  return {};
}

std::string_view takeList(std::string_view &rest) {
  const size_t open = rest.find_first_not_of("]}), \t");
  if (open == 0 || open >= rest.size() || !isOneOf(rest[open], "[{(")) {
    return {};
  }
  const std::string_view list = rest.substr(open + 1, rest.find_first_of("[]{}()<>", open + 1) - open - 1);
  rest.remove_prefix(open + 1 + list.size());
  return countWords(list) > 1 && areNumbers(list) ? list : std::string_view();
}

std::string_view plain(std::string_view text) {
  text = withoutBlanks(text);
  if (text.substr(0, 2) == "\x1b[" && text.find('m') != std::string_view::npos) {
    text.remove_prefix(text.find('m') + 1);
  }
  return withoutBlanks(text.substr(0, text.find('\x1b')));
}

std::string_view withoutLabel(std::string_view text) {
  const size_t colon = std::min(text.find(": "), text.find(":\t"));
  return colon == std::string_view::npos || areNumbers(text.substr(0, colon)) ? text
                                                                              : withoutBlanks(text.substr(colon + 1));
}

bool takeHex(std::string_view word, bool isBad, TextBytes &bytes) {
  takeMark(word);
  for (size_t at = 0; at < word.size(); at += 2) {
    uint8_t value;
    const std::string_view digits = word.substr(at, 2);
    if (!parseWhole(digits, value, 16) || (digits.size() == 1 && word.size() > 1)) {
      return false;
    }
    bytes.push_back({value, isBad && at + 2 >= word.size()});
  }
  return !word.empty();
}

std::string readStrings(std::string_view text, TextBytes &bytes) {
  const size_t escape = text.find('\\');
  const size_t mark = text.find_first_of("'\"");
  const bool isBare = mark > escape || mark == std::string_view::npos;
  for (size_t at = isBare ? escape : mark; at < text.size();) {
    const char quote = isBare ? '\0' : text[at++];
    while (at < text.size() && (isBare || text[at] != quote)) {
      const size_t from = at;
      TextByte byte{static_cast<uint8_t>(text[at++]), false};
      if (text[from] == '\\' && !takeEscape(text, at, byte.value)) {
        return quoted(text.substr(from, 4)) + " is not an escape of Python or C, such as \\x0f";
      }
      bytes.push_back(byte);
    }
    if (!isBare && at == text.size()) {
      return "a string has no end: is the line cut?";
    }
    at = isBare ? at : text.find_first_of("'\"", at + 1);
  }
  return {};
}

std::string readCells(std::string_view text, TextBytes &bytes) {
  for (size_t at = 0; at < text.size(); at += 4) {
    const std::string_view word = withoutBlanks(text.substr(at, 4));
    size_t end = 1;
    TextByte byte{static_cast<uint8_t>(word.empty() ? ' ' : word.front()), false};
    if (word.size() == 3 ? !parseWhole(word, byte.value, 8)
                         : word.size() == 2 && (word.front() != '\\' || !takeEscape(word, end, byte.value))) {
      return quoted(word) + " is not a character as od -c prints it";
    }
    bytes.push_back(byte);
  }
  return {};
}

}  // namespace words

std::string parseHex(std::string_view text, TextBytes &bytes) {
  std::string wrong;
  words::forEachWord(text, [&](std::string_view word, size_t) {
    const size_t before = bytes.size();
    const bool isBad = words::takeBad(word);
    if (!words::takeHex(word, isBad, bytes)) {
      words::takeMark(word);
      wrong = word.substr(std::min(word.size(), 2 * (bytes.size() - before)), 2);
    }
    return wrong.empty();
  });
  return wrong;
}

}  // namespace line
