// Scans a small language on the command line, for example --mix, and reports where it is wrong.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>

#include "cli/options/CsvColumn.h"
#include "cli/options/Subcommand.h"
#include "line/capture/Parsing.h"
#include "line/file/Units.h"
#include "sbus/Scaling.h"

namespace tool {

class Scanner {
 public:
  // Messages begin with `option`.
  Scanner(const char *option, const std::string &text) : _option(option), _text(text) {}

  // Takes a sign or word, and blanks before it. Returns false if something else is next.
  bool take(const char *token) {
    skipBlanks();
    const size_t size = std::strlen(token);
    const bool is = _text.compare(_at, size, token) == 0;
    _at += is ? size : 0;
    _begin = _at;
    return is;
  }

  // Takes letters and digits, and returns them in lower case; "" if none are next.
  std::string word() {
    skipBlanks();
    _at = std::min(_text.find_first_not_of(Letters, _at), _text.size());
    return line::lower(_text.substr(_begin, _at - _begin));
  }

  // Takes a number such as 0.5. Returns false if none is next.
  bool number(double &value) {
    skipBlanks();
    return line::parseNumber(digits(), value);
  }

  // Takes a channel, ch1 to ch`most`; rejects the command line if none is next.
  unsigned channel(unsigned most) {
    const unsigned channel = channelOf(word());
    if (channel == 0 || channel > most) {
      expect("a channel, ch1 to ch" + std::to_string(most) + ",");
    }
    return channel;
  }

  // Takes a channel's value, 1500, 1500us or -50%; rejects the command line if none is next.
  uint16_t value(const sbus::Range &range) {
    skipBlanks();
    _at += _text.compare(_at, 1, "-") == 0 || _text.compare(_at, 1, "+") == 0 ? 1 : 0;
    digits();
    const size_t begin = _begin;
    _at += _text.compare(_at, 2, "us") == 0 ? 2 : _text.compare(_at, 1, "%") == 0 ? 1 : 0;
    const std::optional<uint16_t> raw = line::parseValue(_text.substr(begin, _at - begin), range);
    if (!raw) {
      expect("a value, 0 to 2047, a pulse such as 1500us or a part such as -50%,");
    }
    return *raw;
  }

  // Rejects the command line: `what` is expected in place of the last word, number or value, or at the current place.
  [[noreturn]] void expect(const std::string &what) {
    rejectCommandLine(std::string(_option) + ": \"" + _text + "\": at character " + std::to_string(_begin + 1) + " " +
                      what + " is expected");
  }

  // Rejects the command line unless the text ends here.
  void end(const std::string &what) {
    skipBlanks();
    if (_at < _text.size()) {
      expect(what);
    }
  }

 private:
  static constexpr const char *Letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
  static constexpr const char *Digits = "0123456789";

  void skipBlanks() {
    _at = std::min(_text.find_first_not_of(" \t", _at), _text.size());
    _begin = _at;
  }
  // Takes digits, and a point if another digit follows: 172..1500 are two numbers.
  std::string digits() {
    const size_t from = _at;
    _at = std::min(_text.find_first_not_of(Digits, _at), _text.size());
    if (_text.compare(_at, 1, ".") == 0 && _text.find_first_of(Digits, _at) == _at + 1) {
      _at = std::min(_text.find_first_not_of(Digits, _at + 1), _text.size());
    }
    return _text.substr(from, _at - from);
  }

  const char *const _option;
  const std::string _text;
  size_t _at = 0;     // the next character
  size_t _begin = 0;  // where the last token began
};

}  // namespace tool
