#include "line/file/ByteText.h"

#include <algorithm>
#include <iterator>

#include "sbus/Frame.h"

namespace line {

namespace {

constexpr size_t HeadLines = 200;  // to examine
constexpr size_t HeadNumbers = 9;  // before a line's bytes: those of a date and a time, a count

constexpr const char *Expected =
    " is not hexadecimal; bytes of two digits are expected, such as 0F E3; # begins a comment";

// Returns true if the bytes of a dump's line end here, and text may follow.
bool isTextAt(std::string_view line, size_t at) {
  return at > 0 && at <= line.size() && (line.substr(at, 2) == "  " || withoutBlanks(line.substr(at)).empty());
}

// Returns true if hardly a line has more than one byte, and its number before it: [3] = 0x1F, 3: 1F, 3 1F.
bool isIndexed(std::string_view head) {
  unsigned before = 0;
  size_t found = 0, lines = 0;
  for (size_t i = 0; i < HeadLines && !head.empty(); i++) {
    const std::string_view text = takeLine(head);
    bool isAssigned, areAtEnd;
    const Numbers all = allNumbers(contentOf(text, isAssigned), areAtEnd);
    unsigned index = 0;
    const bool isNext = all.size() == 2 && parseWhole(all[0].text, index) && (index <= 1 || index == before + 1);
    found += isNext || (all.size() == 1 && isAssigned);
    before = index;
    lines += !all.empty();
  }
  return found >= sbus::FrameSize && 10 * found >= 9 * lines;
}

}  // namespace

ByteText::ByteText(std::string_view head, bool isWhole) {
  findOffsets(head);
  if (!hasOffsets() && withoutBlanks(head).substr(0, 8) == "0000000 ") {
    return;  // a dump in another form
  }
  findStyle(head);
  bool isSure = false;
  for (size_t i = 0; i < HeadLines && !head.empty(); i++) {
    const bool isCut = head.find('\n') == std::string_view::npos && !isWhole;
    TextBytes bytes;
    const std::string_view text = takeLine(head);
    if (!line(text, bytes).empty() && !isCut) {
      _lines = i == 0 ? 0 : _lines;  // a later line will be reported
      return;
    }
    if (_lines == 0 && !bytes.empty() && !hasOffsets() && !_isList) {
      _isBare = true;
      forEachWord(text.substr(0, text.find('#')),
                  [this](std::string_view word, std::string_view) { _isBare = _isBare && isNumber(word); });
    }
    _lines += !bytes.empty();
    isSure = isSure || bytes.size() >= RunLeast ||
             std::any_of(bytes.begin(), bytes.end(), [](TextByte byte) { return byte.value == sbus::HeaderByte; });
  }
  _lines = isSure ? _lines : 0;  // a number at the end of lines is a byte if others are
}

// Takes the offset off a line of a dump: 00000010, 0010: or 0010h:.
bool ByteText::takeOffset(std::string_view &text, uint64_t &offset) const {
  const size_t digits = std::min(text.size(), text.find_first_of("h: \t"));
  const size_t colon = text.substr(digits, 1) == "h" ? digits + 1 : digits;
  const bool hasColon = text.substr(std::min(text.size(), colon), 1) == ":";
  const std::string_view behind = text.substr(std::min(text.size(), hasColon ? colon + 1 : digits));
  const bool is =
      digits >= 4 && parseWhole(text.substr(0, digits), offset, _offsetBase) && (behind.empty() || isBlank(behind[0]));
  text = is ? withoutBlanks(behind) : text;
  return is;
}

// Offsets grow from line to line by the number of bytes between them; behind these there may be text.
void ByteText::findOffsets(std::string_view head) {
  for (const int base : {16, 8, 10}) {
    _offsetBase = base;
    _width = 0;
    std::string_view lines = head, before;  // `before`: the bytes of the line before, and the text
    size_t tried = 0, found = 0;
    uint64_t offset = 0, last = 0;
    for (size_t i = 0; i < HeadLines && !lines.empty(); i++) {
      const std::string_view line = withoutBlanks(takeLine(lines));
      std::string_view text = line;
      if (line.empty()) {
        continue;
      }
      const bool isOne = takeOffset(text, offset);
      if (isOne && !before.empty()) {
        uint64_t size = 0;
        size_t end = 0;
        forEachWord(before, [&](std::string_view word, std::string_view) {
          end = last + size < offset ? static_cast<size_t>(word.data() + word.size() - before.data()) : end;
          size += last + size < offset ? (word.size() < 4 ? 1 : word.size() / 2) : 0;
        });
        const bool isMatch = size > 0 && last + size == offset && isTextAt(before, end);
        tried++;
        found += isMatch;
        _width = isMatch ? std::max(_width, end) : _width;
      }
      before = isOne ? text : std::string_view();
      last = offset;
      _areSwapped = isOne ? line.substr(0, line.find(' ')).find(':') == line.npos : _areSwapped;
    }
    if (found > 0 && 3 * found >= tried) {  // numbers may look like offsets here and there
      return;
    }
  }
  _offsetBase = 0;
  _width = 0;
}

// Finds out what the numbers of the first lines look like.
void ByteText::findStyle(std::string_view head) {
  _hasIndex = !hasOffsets() && isIndexed(head);
  _isList = _hasIndex;
  bool any = false, hasLetters = false;
  for (size_t i = 0; i < HeadLines && !head.empty(); i++) {
    const std::string_view text = takeLine(head);
    _hasStrings = _hasStrings || (text.substr(0, 1) != "#" && hasEscapes(text));
    forEachWord(text, [this](std::string_view word, std::string_view) {
      _hasMarks = (isNumber(word) && takeMark(word)) || _hasMarks;
    });
    for (TextNumber &number : numbersOf(text)) {
      any = true;
      takeEnd(number.text, '!');
      takeMark(number.text);
      _hasWords = _hasWords || (hasOffsets() && number.text.size() >= 4);
      hasLetters = hasLetters || !std::all_of(number.text.begin(), number.text.end(), isDigit);
      _isList = _isList || number.isFirst;
    }
  }
  _isList = _isList || _hasMarks || _hasStrings;
  _base = any && !_hasMarks && !hasLetters && !hasOffsets() ? 10 : 16;  // each frame has 0F
}

// Returns the numbers of a line that are its bytes: those in runs with the same sign between them. On a line with fewer
// bytes they are the last numbers. What precedes them is a log's: a date, a time, an address, a label.
Numbers ByteText::numbersOf(std::string_view line) const {
  std::string_view text = withoutBlanks(line);
  uint64_t offset;
  if (hasOffsets() && !takeOffset(text, offset)) {
    return {};
  }
  if (hasOffsets()) {  // without the text beside the bytes; the last word may stand apart
    const size_t blanks = text.size() > _width ? text.find("  ") : text.npos;
    text = text.substr(0, isTextAt(text, _width) ? _width : std::min({blanks, text.find(" |"), text.find(" ;")}));
  }
  bool isAssigned, areAtEnd;
  const Numbers all = allNumbers(contentOf(text, isAssigned), areAtEnd);
  const Runs runs = runsOf(all);
  if (_hasIndex) {
    return all.size() == 2 ? Numbers{all[1]} : all.size() == 1 && isAssigned ? all : Numbers();
  }
  // A frame in parts: 0F | E3 03 ... | 00 00; or one after a time or a count, which has another sign or is no byte.
  for (size_t from = 0; from + 1 < all.size() && from < HeadNumbers && !isFrame(runs.bytes); from++) {
    const Numbers rest(all.begin() + static_cast<std::ptrdiff_t>(from), all.end());
    if ((from == 0 || all[from].sign != rest[1].sign || all[from - 1].text.size() > 3) && isFrame(rest)) {
      return rest;
    }
  }
  if (!runs.bytes.empty()) {
    return runs.bytes;
  }
  if (_hasMarks) {
    Numbers marked;
    std::copy_if(all.begin(), all.end(), std::back_inserter(marked),
                 [](TextNumber number) { return takeMark(number.text); });
    return marked;
  }
  return areAtEnd && !endsWithTime(all, runs.last) ? runs.last : Numbers();
}

bool ByteText::isFrame(const Numbers &numbers) const {
  TextBytes bytes;
  for (const TextNumber &number : numbers) {
    read(number, bytes);
    if (bytes.empty() || bytes[0].value != sbus::HeaderByte) {
      return false;
    }
  }
  return isFrameAt(bytes, 0) || isFrameAt(bytes, 0, sbus::FrameSize24);
}

std::string ByteText::line(std::string_view text, TextBytes &bytes) const {
  if (hasOffsets() && withoutBlanks(text) == "*") {
    return "* stands for lines like the one above: a dump with all its lines is expected, by hexdump -v, od -v or xxd";
  }
  if (_hasStrings) {
    return text.find_first_of("\\'\"") == text.npos ? "" : readStrings(withoutBlanks(text), bytes);
  }
  std::string wrong;
  size_t words = 0, others = 0;
  forEachWord(_isBare ? text.substr(0, text.find('#')) : "", [&](std::string_view word, std::string_view) {
    words++;
    others += !isNumber(word);
    wrong = wrong.empty() && !isNumber(word) ? quoted(word) + Expected : wrong;
  });
  const Numbers numbers = numbersOf(text);
  if (!_isStrict && others > 0 && (2 * others >= words || numbers.size() < RunLeast)) {
    return {};
  }
  for (const TextNumber &number : numbers) {
    wrong = wrong.empty() ? read(number, bytes) : wrong;
  }
  return wrong;
}

// hexdump and od print words as a PC reads them, their lowest byte last.
std::string ByteText::read(const TextNumber &number, TextBytes &bytes) const {
  const size_t from = bytes.size();
  if (_base == 16) {
    const bool isGood = takeHex(number.text, bytes);
    if (isGood && hasOffsets() && number.text.size() >= 4 && _areSwapped) {
      std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(from), bytes.end());
    }
    return isGood ? "" : quoted(number.text) + Expected;
  }
  unsigned value = 0;
  std::string_view digits = number.text;
  const bool isBad = takeEnd(digits, '!');
  if (!parseWhole(digits, value) || value > (number.isNegative ? 128u : 255u)) {
    return quoted(number.text) + " is not a byte; numbers up to 255 are expected";
  }
  bytes.push_back({static_cast<uint8_t>(number.isNegative ? 256 - value : value), isBad});
  return {};
}

}  // namespace line
