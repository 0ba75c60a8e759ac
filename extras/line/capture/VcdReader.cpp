#include "line/capture/VcdReader.h"

#include <algorithm>
#include <cmath>

#include "line/capture/CsvLayout.h"
#include "line/capture/Parsing.h"

namespace line {

namespace {

constexpr double NumberMax = 1e9;  // highest number of a bit

// Takes "7:0" from "[7:0]", or "3" from "[3]"; leaves the numbers unchanged if it is not a range.
void takeRange(std::string_view range, double &highest, double &lowest) {
  const char *at = range.data() + 1;
  const char *end = range.data() + range.size();
  double first, last;
  if (range.empty() || range.front() != '[' || !takeNumber(at, end, first) || !(first < NumberMax)) {
    return;
  }
  highest = lowest = first;
  if (at < end && *at == ':' && takeNumber(++at, end, last) && last < NumberMax) {
    lowest = last;
  }
}

}  // namespace

std::string VcdReader::put(std::string_view lines) {
  while (!lines.empty()) {
    std::string_view line = takeLine(lines);
    _lines++;
    for (std::string_view word = takeWord(line); !word.empty(); word = takeWord(line)) {
      std::string error = _inBody ? bodyWord(word) : headerWord(word);
      if (!error.empty()) {
        return error;
      }
    }
  }
  return {};
}

std::string VcdReader::finish() {
  return _inBody ? "" : "ends within its header: $enddefinitions $end is expected, and value changes after it";
}

std::string VcdReader::headerWord(std::string_view word) {
  if (_section.empty()) {
    if (word.front() != '$') {
      return quoted(word) + " is outside a section: one such as $var or $enddefinitions is expected";
    }
    _section = word;
    _words.clear();
    return {};
  }
  if (word == "$end") {
    std::string error = endSection();
    _section.clear();
    return error;
  }
  if (_words.size() < 16) {
    _words.emplace_back(word);
  }
  return {};
}

std::string VcdReader::endSection() {
  if (_section == "$timescale") {
    std::string text;
    for (const std::string &word : _words) {
      text += word;
    }
    const char *at = text.data();
    double number = 0;
    const bool isNumber = takeNumber(at, text.data() + text.size(), number);
    const double unitNs = unitIn({at, static_cast<size_t>(text.data() + text.size() - at)});
    _unitNs = isNumber && (number == 1 || number == 10 || number == 100) && unitNs > 0 ? number * unitNs : _unitNs;
    return _unitNs > 0 ? ""
                       : quoted(text) + " is not a timescale: 1, 10 or 100 and s, ms, us, ns, ps or fs is expected";
  }
  if (_section == "$scope") {
    _scopes.push_back(_words.size() > 1 ? _words[1] : "");
  } else if (_section == "$upscope" && !_scopes.empty()) {
    _scopes.pop_back();
  } else if (_section == "$var") {
    return defineVariable();
  } else if (_section == "$enddefinitions") {
    if (_unitNs == 0) {
      return "there is no $timescale before this line: one such as $timescale 1 us $end is expected";
    }
    if (_names.empty()) {
      return std::string("there is no variable of bits before this line") +
             (_hasReals ? ", but of real numbers: export the signal as CSV, whose voltages are read"
                        : ": one such as $var wire 1 ! SBUS $end is expected");
    }
    _inBody = true;
    _sink.signals(_names);
  }
  return {};
}

std::string VcdReader::defineVariable() {
  if (_words.size() < 4) {
    return "a variable is not complete: type, number of bits, code and name are expected";
  }
  double width;
  _hasReals = _hasReals || _words[0] == "real";
  if (_words[0] == "real" || !parseNumber(_words[1], width) || !(width >= 1) ||
      static_cast<double>(_names.size()) + width > static_cast<double>(SignalsMax)) {
    return {};
  }
  const std::string &code = _words[2];
  if (signalOf(code) != None) {
    return {};  // the same wire in another module
  }
  if (code.size() == 1 && static_cast<unsigned char>(code[0]) < _byCharacter.size()) {
    _byCharacter[static_cast<unsigned char>(code[0])] = _names.size();
  } else {
    _byCode[code] = _names.size();
  }
  // "bus[7:0]" or "bus [7:0]"
  const size_t bracket = std::min(_words[3].find('[', 1), _words[3].size());
  const std::string range = bracket < _words[3].size() ? _words[3].substr(bracket) : _words.size() > 4 ? _words[4] : "";
  const bool numbered = width > 1 || range.substr(0, 1) == "[";
  double highest = width - 1, lowest = 0;
  takeRange(range, highest, lowest);
  for (double i = 0; i < width; i++) {
    const double number = lowest + (highest < lowest ? -i : i);
    std::string name = _words[3].substr(0, bracket);
    name += numbered ? "[" + std::to_string(std::llround(number)) + "]" : "";
    if (std::find(_names.begin(), _names.end(), name) != _names.end() && !_scopes.empty()) {
      name = _scopes.back() + "." + name;
    }
    _names.push_back(name);
    _widths.push_back(static_cast<size_t>(width));
  }
  return {};
}

size_t VcdReader::signalOf(std::string_view code) const {
  if (code.size() == 1 && static_cast<unsigned char>(code[0]) < _byCharacter.size()) {
    return _byCharacter[static_cast<unsigned char>(code[0])];
  }
  const auto entry = _byCode.find(std::string(code));
  return entry == _byCode.end() ? None : entry->second;
}

std::string VcdReader::bodyWord(std::string_view word) {
  if (_passing) {
    _passing = word != "$end";
    return {};
  }
  if (_codeFollows) {
    _codeFollows = false;
    setVector(signalOf(word));
    return {};
  }
  switch (word.front()) {
    case '0':
    case '1': {
      const size_t signal = signalOf(word.substr(1));
      if (signal != None) {
        _sink.level(signal, _ns, word.front() == '1');
      }
      return word.size() > 1 ? "" : "a value has no code: one such as 1! is expected";
    }
    case '#':
      return setTime(word.substr(1));
    case 'x':
    case 'X':
    case 'z':
    case 'Z':
      return {};  // unknown
    case 'b':
    case 'B':
    case 'r':
    case 'R':
    case 's':  // a string: written by GTKWave
    case 'S':
      _codeFollows = true;
      _bits = word.front() == 'b' || word.front() == 'B' ? word.substr(1) : "";
      return {};
    case '$':
      _passing = word == "$comment";
      return {};
    default:
      return quoted(word) + " is not a value change: #TIME, or 0 or 1 and a variable's code is expected";
  }
}

// Bits missing from the value are 0, or x or z if the value begins with x or z.
void VcdReader::setVector(size_t lowest) {
  for (size_t i = 0; lowest != None && !_bits.empty() && i < _widths[lowest]; i++) {
    const char bit = i < _bits.size() ? _bits[_bits.size() - 1 - i] : _bits.front() == '1' ? '0' : _bits.front();
    if (bit == '0' || bit == '1') {
      _sink.level(lowest + i, _ns, bit == '1');
    }
  }
}

std::string VcdReader::setTime(std::string_view digits) {
  constexpr size_t DigitsMax = 18;
  uint64_t time = 0;
  if (digits.size() > DigitsMax || !parseWhole(digits, time)) {
    return quoted(digits) + " is not a time: a whole number is expected after #";
  }
  if (static_cast<double>(time) * _unitNs > static_cast<double>(CaptureTimeMaxNs)) {
    return "time " + std::to_string(time) + " is later than a year: is the timescale right?";
  }
  const int64_t ns = std::llround(static_cast<double>(time) * _unitNs);
  if (ns < _ns) {
    return "time " + std::to_string(time) + " is before the previous one: times in order are expected";
  }
  _ns = ns;
  _endNs = ns;
  return {};
}

}  // namespace line
