#include "cli/options/Scanner.h"

#include <algorithm>
#include <cstring>
#include <optional>

#include "line/file/Units.h"
#include "cli/options/CsvColumn.h"
#include "cli/options/Subcommand.h"
#include "line/capture/Parsing.h"

namespace tool {

namespace {

constexpr const char *Letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
constexpr const char *Digits = "0123456789";

}  // namespace

void Scanner::skipBlanks() {
  _at = std::min(_text.find_first_not_of(" \t", _at), _text.size());
  _begin = _at;
}

bool Scanner::take(const char *token) {
  skipBlanks();
  const size_t size = std::strlen(token);
  const bool is = _text.compare(_at, size, token) == 0;
  _at += is ? size : 0;
  _begin = _at;
  return is;
}

std::string Scanner::word() {
  skipBlanks();
  _at = std::min(_text.find_first_not_of(Letters, _at), _text.size());
  return line::lower(_text.substr(_begin, _at - _begin));
}

// Takes digits, and a point if another digit follows: 172..1500 are two numbers.
std::string Scanner::digits() {
  const size_t from = _at;
  _at = std::min(_text.find_first_not_of(Digits, _at), _text.size());
  if (_text.compare(_at, 1, ".") == 0 && _text.find_first_of(Digits, _at) == _at + 1) {
    _at = std::min(_text.find_first_not_of(Digits, _at + 1), _text.size());
  }
  return _text.substr(from, _at - from);
}

bool Scanner::number(double &value) {
  skipBlanks();
  return line::parseNumber(digits(), value);
}

unsigned Scanner::channel(unsigned most) {
  const unsigned channel = channelOf(word());
  if (channel == 0 || channel > most) {
    expect("a channel, ch1 to ch" + std::to_string(most) + ",");
  }
  return channel;
}

uint16_t Scanner::value(const sbus::Range &range) {
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

void Scanner::expect(const std::string &what) {
  rejectCommandLine(std::string(_option) + ": \"" + _text + "\": at character " + std::to_string(_begin + 1) + " " +
                    what + " is expected");
}

void Scanner::end(const std::string &what) {
  skipBlanks();
  if (_at < _text.size()) {
    expect(what);
  }
}

}  // namespace tool
