#include "line/file/TextNumbers.h"

#include <algorithm>

namespace line {

namespace {

bool isHexDigit(char c) { return isDigit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F'); }

// Returns the sign between two numbers of a list; 0 if they are not of one.
char signOf(std::string_view between) {
  std::string signs;
  for (const char c : between) {
    signs += isBlank(c) || c == '\'' || c == '"' ? "" : std::string(1, c);
  }
  const bool isAlone = signs.size() == between.size();
  return signs.empty()                                                                 ? ' '
         : signs.size() == 1 && isOneOf(signs[0], isAlone ? ",;|:-._" : ",;|")         ? signs[0]
         : signs.size() == 2 && isOneOf(signs[0], "]})>") && isOneOf(signs[1], "[{(<") ? '['
                                                                                       : '\0';
}

// Returns how many octal digits are there: up to three of them are a byte.
size_t octalDigits(std::string_view text, size_t at) {
  const std::string_view digits = text.substr(std::min(at, text.size()), 3);
  return std::min(digits.find_first_not_of("01234567"), digits.size());
}

// Takes the character after a backslash, as Python and C write it. Returns false for others.
bool takeEscape(std::string_view text, size_t &at, uint8_t &value) {
  constexpr std::string_view Letters = "abfnrtv\\'\"";
  constexpr std::string_view Values = "\a\b\f\n\r\t\v\\'\"";
  const char letter = at < text.size() ? text[at] : '\0';
  if (letter == 'x') {
    at += 3;
    return at <= text.size() && parseWhole(text.substr(at - 2, 2), value, 16);
  }
  const size_t octal = octalDigits(text, at);
  if (octal > 0) {
    at += octal;
    return parseWhole(text.substr(at - octal, octal), value, 8);
  }
  const size_t known = Letters.find(letter);
  value = known == Letters.npos ? uint8_t{0} : static_cast<uint8_t>(Values[known]);
  at++;
  return known != Letters.npos;
}

}  // namespace

bool isFrameAt(const TextBytes &bytes, size_t at, size_t size) {
  return at + size <= bytes.size() && bytes[at].value == sbus::HeaderByte &&
         sbus::isFlagsByte(bytes[at + size - 2].value) && sbus::isEndByte(bytes[at + size - 1].value);
}

bool takeEnd(std::string_view &word, char end) {
  const bool has = word.size() > 1 && word.back() == end;
  word.remove_suffix(has ? 1 : 0);
  return has;
}

bool takeMark(std::string_view &word) {
  const bool has = word.size() > 2 && word[0] == '0' && (word[1] == 'x' || word[1] == 'X');
  word.remove_prefix(has ? 2 : 0);
  return has;
}

bool isNumber(std::string_view word) {
  takeEnd(word, '!');
  const bool isMarked = takeMark(word);
  const size_t size = word.size();
  const bool isOdd = size % 2 != 0 && size > 1 && !(size == 3 && std::all_of(word.begin(), word.end(), isDigit));
  return size > 0 && std::all_of(word.begin(), word.end(), isHexDigit) && !isOdd &&
         !(isMarked && size > 2 && size <= 16);
}

bool takeHex(std::string_view word, TextBytes &bytes) {
  const bool isBad = takeEnd(word, '!');
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

bool hasEscapes(std::string_view text) {
  size_t octal = 0;
  for (size_t at = text.find('\\'); at != text.npos; at = text.find('\\', at + 1)) {
    octal += octalDigits(text, at + 1) > 0;
  }
  return text.find("\\x") != text.npos || octal >= RunLeast;
}

std::string readStrings(std::string_view text, TextBytes &bytes) {
  const size_t escape = text.find('\\');
  const size_t mark = text.find_first_of("'\"");
  const bool isBare = mark > escape || mark == text.npos;
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

std::string_view contentOf(std::string_view text, bool &isAssigned) {
  for (const char *const mark : {"//", "/*", "#"}) {
    text = text.substr(0, text.find(mark));
  }
  std::string_view best;
  size_t most = 0;
  isAssigned = false;
  for (size_t begin = 0; begin <= text.size();) {
    const std::string_view part = text.substr(begin, text.find('=', begin) - begin);
    size_t count = 0;
    forEachWord(part, [&count](std::string_view word, std::string_view) { count += isNumber(word); });
    if (count >= most || most < RunLeast) {  // data[300] = { has none of its own
      isAssigned = begin > 0;
      best = part;
      most = count;
    }
    begin += part.size() + 1;
  }
  return best;
}

Numbers allNumbers(std::string_view text, bool &areAtEnd) {
  Numbers all;
  bool isAfterNumber = false;
  forEachWord(text, [&](std::string_view word, std::string_view before) {
    const bool isNegative = before.size() > 1 && before.back() == '-' && isOneOf(before[before.size() - 2], " ,[{(");
    before.remove_suffix(isNegative ? 1 : 0);
    const size_t sign = before.find_last_not_of(" '\"");
    const bool is = isNumber(word);
    if (is) {
      all.push_back({word, isAfterNumber ? signOf(before) : '\0', isNegative,
                     sign != before.npos && isOneOf(before[sign], "[{(<")});
    }
    isAfterNumber = is;
  });
  areAtEnd = isAfterNumber;
  return all;
}

Runs runsOf(const Numbers &all) {
  Runs runs;
  for (size_t begin = 0, end = 0, taken = 0; begin < all.size();
       begin = end < all.size() && all[end].sign != '\0' ? end - 1 : end) {
    for (end = begin + 1; end < all.size() && all[end].sign != '\0' && all[end].sign == all[begin + 1].sign; end++) {
    }
    // The end of 18:12:30,345 is no byte; after bytes, as a field of its own, or with two digits, it is one.
    std::string_view digits = all[begin].text;
    const bool isByte = takeMark(digits) || digits.size() == 2;
    const bool isField = isOneOf(all[begin].sign, ",;|") && (begin < 2 || all[begin - 1].sign != ':' || isByte);
    const bool isOthers = isOneOf(all[begin].sign, ",;|:-._") && !isField && !(taken > 0 && taken == begin);
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(std::max(begin + isOthers, taken));
    runs.last.assign(first, all.begin() + static_cast<std::ptrdiff_t>(end));
    const bool isLong = std::any_of(runs.last.begin(), runs.last.end(),
                                    [](const TextNumber &each) { return each.text.size() >= 4 * RunLeast; });
    if (runs.last.size() >= RunLeast || isLong) {
      runs.bytes.insert(runs.bytes.end(), runs.last.begin(), runs.last.end());
      taken = end;
    }
  }
  return runs;
}

bool endsWithTime(const Numbers &all, const Numbers &last) {
  const size_t size = all.size();
  return size > last.size() && size > 2 && isOneOf(all[size - 1].sign, ":.-") && isOneOf(all[size - 2].sign, ":.-");
}

std::string parseHex(std::string_view text, TextBytes &bytes) {
  std::string wrong;
  forEachWord(text, [&](std::string_view word, std::string_view) {
    const size_t before = bytes.size();
    if (wrong.empty() && !takeHex(word, bytes)) {
      takeMark(word);
      wrong = word.substr(std::min(word.size(), 2 * (bytes.size() - before)), 2);
    }
  });
  return wrong;
}

bool parseHex(std::string_view text, std::vector<Character> &characters) {
  TextBytes bytes;
  const bool isGood = parseHex(text, bytes).empty() && !bytes.empty();
  for (const TextByte &byte : bytes) {
    characters.push_back({0, byte.value, byte.bad});
  }
  return isGood;
}

}  // namespace line
