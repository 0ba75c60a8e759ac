#include "line/file/ByteText.h"

#include <algorithm>
#include <utility>

#include "line/recording/Words.h"
#include "sbus/Frame.h"

namespace line {

using namespace words;

namespace {

constexpr size_t HeadLines = 200;           // to examine
constexpr size_t PerLineMost = 1024;        // bytes, in a dump
constexpr uint64_t RepeatedMost = 1 << 20;  // bytes, by the * of a dump

constexpr const char *Expected =
    " is not hexadecimal; bytes of two digits are expected, such as 0F E3; # begins a comment";

}  // namespace

// What the numbers of the first lines look like.
struct ByteText::Style {
  bool hasMarks = false, hasLetters = false, hasLeadingZeros = false, hasOneDigit = false, hasThree = false;
  bool hasCommas = false;
  bool isBinary = true, isOctal = true;
  size_t size = 0;  // digits of the first number
  size_t count = 0;

  void take(std::string_view word) {
    takeBad(word);
    hasMarks = takeMark(word) || hasMarks;
    size = count++ == 0 ? word.size() : size;
    hasLetters = hasLetters || !areAll(word, isDigit);
    hasThree = hasThree || word.size() == 3;
    hasOneDigit = hasOneDigit || word.size() == 1;
    hasLeadingZeros = hasLeadingZeros || (word.size() == 2 && word.front() == '0');
    isBinary = isBinary && word.size() == 8 && word.find_first_not_of("01") == std::string_view::npos;
    isOctal = isOctal && word.size() == size && (size == 3 || size == 6) &&
              word.find_first_not_of("01234567") == std::string_view::npos && word.front() < (size == 3 ? '4' : '2');
  }

  int base() const {
    return hasMarks                                    ? 16
           : count > 0 && isBinary                     ? 2
           : hasLetters                                ? 16
           : count > 0 && isOctal                      ? 8
           : hasThree                                  ? 10
           : hasCommas && hasOneDigit && !hasLeadingZeros ? 10
                                                       : 16;
  }
};

size_t frameAt(const TextBytes &bytes) {
  for (const size_t size : {size_t{sbus::FrameSize}, size_t{sbus::FrameSize24}}) {
    if (bytes.size() >= size && bytes[0].value == sbus::HeaderByte && sbus::isFlagsByte(bytes[size - 2].value) &&
        sbus::isEndByte(bytes[size - 1].value)) {
      const uint8_t variant = sbus::variantOfEnd(bytes[size - 1].value);
      const size_t tail = size == sbus::FrameSize ? sbus::LineVariants[variant].tailSize : 0;
      return std::min(bytes.size(), size + tail);  // a line may hold the frame alone
    }
  }
  return 0;
}

namespace {

// Returns true if these are a frame without the tail that its variant has on the line.
bool lacksTail(const TextBytes &bytes) {
  return bytes.size() == sbus::FrameSize && sbus::LineVariants[sbus::variantOfEnd(bytes[sbus::EndIndex].value)].tailSize > 0;
}

}  // namespace

ByteText::ByteText(std::string_view head, bool isWhole) {
  findOffsets(head);
  findStyle(head);
  _isBare = _form == Form::Numbers && !_isList && !hasOffsets() && _isBare;
  for (size_t i = 0; i < HeadLines && !head.empty(); i++) {
    const bool isCut = head.find('\n') == std::string_view::npos && !isWhole;
    TextBytes bytes;
    if (!read(takeLine(head), bytes).empty() && !isCut) {
      _lines = i == 0 ? 0 : _lines;  // a later line will be reported
      return;
    }
    const size_t frame = frameAt(bytes);
    const TextBytes rest(bytes.begin() + static_cast<std::ptrdiff_t>(frame), bytes.end());
    _lines += !bytes.empty();
    _frameLines += frame > 0;
    _filledLines += frame > 0 && (rest.empty() ? lacksTail(bytes) : frameAt(rest) == 0);
  }
}

// Takes the offset off the beginning of a line: 00000010, 0010:, 0x20000010.
bool ByteText::takeOffset(std::string_view &text, uint64_t &offset) const {
  std::string_view rest = withoutLabel(text);
  std::string_view word = takeWord(rest);
  std::string digits(word);
  digits.resize(digits.size() - (!digits.empty() && digits.back() == ':' ? 1 : 0));
  digits.erase(0, digits.compare(0, 2, "0x") == 0 ? 2 : 0);
  if (digits.size() < 4 || !parseWhole(digits, offset, _offsetBase)) {
    return false;
  }
  text = rest;
  return true;
}

// Offsets grow from line to line by the number of bytes between them. These end the line, or two blanks follow.
void ByteText::findOffsets(std::string_view head) {
  for (const int base : {16, 10, 8}) {
    _offsetBase = base;
    std::string_view lines = head, before;
    uint64_t offset = 0, next = 0;
    for (size_t i = 0; i < HeadLines && !lines.empty(); i++) {
      const std::string_view line = plain(takeLine(lines));
      std::string_view rest = line, numbers = before;
      if (!takeOffset(rest, next)) {
        before = {};
        continue;
      }
      if (takeOffset(numbers, offset) && next > offset && next - offset <= PerLineMost) {
        const auto wanted = static_cast<size_t>(next - offset);
        size_t end = 0, has = 0;
        std::string_view first;
        forEachWord(numbers, [&](std::string_view word, size_t column) {
          first = first.empty() ? word : first;
          has += isNumber(word) ? sizeOf(word, first) : wanted + 1;
          end = column + word.size();
          return has < wanted;
        });
        const std::string_view behind = numbers.substr(end);
        const bool fits = has == wanted && (behind.empty() || isOneOf(behind[0], ",|") || behind.substr(0, 2) == "  ");
        const auto from = static_cast<size_t>(numbers.data() - before.data());
        // od -c: each character takes four columns.
        const bool areCells = !fits && !areNumbers(numbers) && from == 7 && before.size() == from + 4 * wanted;
        if (!fits && !areCells) {
          break;
        }
        _form = areCells ? Form::Cells : Form::Numbers;
        _perLine = wanted;
        _endColumn = areCells ? before.size() : from + end;
        return;
      }
      before = line;
    }
  }
  _offsetBase = 0;
}

void ByteText::findStyle(std::string_view head) {
  Style style;
  std::string_view first;  // line with an offset
  for (size_t i = 0; i < HeadLines && !head.empty(); i++) {
    const std::string_view text = takeLine(head);
    std::string_view rest = plain(text);
    uint64_t offset;
    first = first.empty() && hasOffsets() && takeOffset(rest, offset) ? plain(text) : first;
    // An escape within quotation marks, or a single one: \x0f\x5b is a number, too.
    const size_t escape = text.find('\\');
    const bool hasEscape = escape < text.size() - 1 && isOneOf(text[escape + 1], "xu0") && !hasOffsets();
    const std::string_view numbers = numbersOf(text);
    if (hasEscape && (text.find_first_of("'\"") < escape || !areNumbers(numbers))) {
      _form = Form::Strings;
    }
    const std::string_view bare = plain(text.substr(0, text.find('#')));
    _isBare = _isBare && (numbers.empty() || withoutBlanks(numbers) == bare);
    style.hasCommas = style.hasCommas || numbers.find(',') != std::string_view::npos;
    _isList = _isList || !listOf(plain(text)).empty();
    forEachWord(numbers, [&style](std::string_view word, size_t) {
      style.take(word);
      return true;
    });
  }
  _base = style.base();
  _isList = _isList || _form == Form::Strings || style.hasMarks;
  if (hasOffsets() && style.size >= 4 && _base != 2) {
    findOrder(first);
  }
}

// hexdump and od print words as a PC reads them, their lowest byte last. xxd does so by -e: its text shows it.
void ByteText::findOrder(std::string_view line) {
  const std::string_view offset = line.substr(0, line.find(' '));
  _isSwapped = true;
  TextBytes bytes;
  const std::string_view ascii = withoutBlanks(line.substr(std::min(line.size(), _endColumn)));
  if (offset.back() == ':' && read(line, bytes).empty() && bytes.size() >= ascii.size()) {
    for (size_t i = 0; i < ascii.size(); i++) {
      _isSwapped = _isSwapped && (ascii[i] == '.' || static_cast<uint8_t>(ascii[i]) == bytes[i].value);
    }
    _isSwapped = _isSwapped && !ascii.empty();
  } else {
    _isSwapped = offset.back() != ':';
  }
}

// Returns the part of a line that holds numbers.
std::string_view ByteText::numbersOf(std::string_view line) const {
  std::string_view text = plain(line);
  const std::string_view whole = text;
  uint64_t offset;
  if (hasOffsets()) {
    if (!takeOffset(text, offset)) {
      return {};
    }
    const auto from = static_cast<size_t>(text.data() - whole.data());
    return text.substr(0, std::max(from, _endColumn) - from);
  }
  // What a dump shows as text, in |...| or >...<.
  if (!text.empty() && (text.back() == '|' || text.back() == '<')) {
    text = text.substr(0, text.find(text.back() == '|' ? " |" : " >"));
  }
  for (const char *const mark : {"//", "/*", "#"}) {
    text = text.substr(0, text.find(mark));
  }
  const std::string_view list = listOf(text);
  if (!list.empty()) {
    return list;
  }
  // "uint8_t frame[25] = {" and "unsigned size = 25;" hold no bytes.
  const size_t equals = text.rfind('=');
  if (equals != std::string_view::npos && countWords(text.substr(equals)) < 2) {
    return {};
  }
  text = equals == std::string_view::npos ? text : text.substr(equals + 1);
  const size_t colon = std::min(text.find(": "), text.find(":\t"));
  text = colon == std::string_view::npos ? text : text.substr(colon + 1);
  text.remove_prefix(text.substr(0, 2) == "b'" || text.substr(0, 2) == "b\"" ? 1 : 0);
  const size_t arrow = std::min({text.find("->"), text.find("<-"), text.find("=>")});
  text = arrow == std::string_view::npos ? text : text.substr(arrow + 2);
  for (std::string_view rest = text;; text = rest) {
    const std::string_view word = takeWord(rest);
    if (word.empty() || !isPrefix(word)) {
      break;
    }
    // "RX:0F", "bytes.fromhex('0F...')", "%0F"
    const size_t end = word.find_last_of(":('\"", word.size() - 3);
    if (end != std::string_view::npos && word.size() > 3 && !areNumbers(word) && areNumbers(word.substr(end)) &&
        countWords(word.substr(end)) > 0) {
      text = text.substr(static_cast<size_t>(word.data() - text.data()) + end);
      break;
    }
    if (countWords(rest) == 0) {
      return {};
    }
  }
  // An address, and the text of a dump behind two blanks.
  std::string_view rest = text;
  const std::string_view word = takeWord(rest);
  const bool isAddress = word.substr(0, 2) == "0x"
                             ? word.size() > 6
                             : word.size() >= 4 && word.find_first_not_of('0') == std::string_view::npos;
  text = isAddress && countWords(rest) > 0 ? withoutBlanks(rest) : withoutBlanks(text);
  for (size_t gap = text.find("  "); gap != std::string_view::npos; gap = text.find("  ", gap + 2)) {
    if (!areNumbers(text.substr(gap)) && areNumbers(text.substr(0, gap))) {
      const std::string_view behind = withoutBlanks(text.substr(gap));
      const bool goesOn = areNumbers(behind.substr(0, behind.find(' '))) && behind.find("  ") != behind.npos;
      text = goesOn ? text : text.substr(0, gap);
    }
  }
  return text;
}

// Reads the bytes of a line.
std::string ByteText::read(std::string_view line, TextBytes &bytes) const {
  if (_form == Form::Strings) {
    return line.find('\\') == std::string_view::npos && line.find_first_of("'\"") == std::string_view::npos
               ? ""
               : readStrings(plain(line), bytes);
  }
  if (_form == Form::Cells) {
    uint64_t offset;
    std::string_view cells = line;
    return takeOffset(cells, offset) ? readCells(cells, bytes) : "";
  }
  const std::string_view text = numbersOf(line);
  std::string wrong;
  std::string_view words = plain(line.substr(0, line.find('#')));
  if (_isBare && countWords(text) == 0 && countWords(words) > 0) {
    return quoted(takeWord(words)) + Expected;
  }
  const auto take = [&](std::string_view word, size_t column) {
    const size_t from = bytes.size();
    if (!readNumber(word, column > 0 && word.data()[-1] == '-', bytes)) {
      wrong = quoted(word) + (_base == 16 ? Expected : " is not a byte; numbers up to 255 are expected");
      return false;
    }
    if (_isSwapped) {
      std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(from), bytes.end());
    }
    return true;
  };
  bool goesOn = forEachWord(text, take) && _isList && !hasOffsets() && !text.empty();
  std::string_view rest = goesOn ? line.substr(static_cast<size_t>(text.data() + text.size() - line.data())) : "";
  for (std::string_view list = takeList(rest); goesOn && !list.empty(); list = takeList(rest)) {
    goesOn = forEachWord(list, take);
  }
  return wrong;
}

bool ByteText::readNumber(std::string_view word, bool isNegative, TextBytes &bytes) const {
  const bool isBad = takeBad(word);
  if (_base == 16) {
    return takeHex(word, isBad, bytes);
  }
  unsigned value = 0;
  const bool isWord = _base == 8 && word.size() == 6;
  if (!parseWhole(word, value, _base) || value > (isWord ? 65535u : isNegative && _base == 10 ? 128u : 255u)) {
    return false;
  }
  if (isWord) {
    bytes.push_back({static_cast<uint8_t>(value >> 8), false});
  }
  bytes.push_back({static_cast<uint8_t>(isNegative && _base == 10 ? 256 - value : value), isBad});
  return true;
}

std::string ByteText::line(std::string_view text, TextBytes &bytes) {
  std::string_view rest = plain(text);
  uint64_t offset;
  if (hasOffsets() && rest == "*") {
    _repeats = true;
    return {};
  }
  if (hasOffsets() && takeOffset(rest, offset)) {
    // A byte at a dump's end is filled up to a word.
    const uint64_t surplus = _hasOffset && _at > offset ? _at - offset : 0;
    _held.resize(_held.size() - static_cast<size_t>(std::min<uint64_t>(_held.size(), surplus)));
    const std::string wrong = std::exchange(_repeats, false) ? repeat(offset, bytes) : "";
    if (!wrong.empty()) {
      return wrong;
    }
    _at = offset;
    _hasOffset = true;
  }
  finish(bytes);
  const std::string wrong = read(text, _held);
  _at += _held.size();
  if (!hasOffsets()) {
    finish(bytes);
  }
  return wrong;
}

// Takes the * of a dump: the line before it stands for all up to this offset.
std::string ByteText::repeat(uint64_t offset, TextBytes &bytes) {
  if (_held.empty() || offset < _at || offset - _at > RepeatedMost) {
    return "* stands for the line above, but not up to this offset: a dump with all its lines is expected, by -v";
  }
  for (; _at < offset; _at += _held.size()) {
    bytes.insert(bytes.end(), _held.begin(), _held.end());
  }
  return {};
}

void ByteText::finish(TextBytes &bytes) {
  bytes.insert(bytes.end(), _held.begin(), _held.end());
  _held.clear();
}

}  // namespace line
