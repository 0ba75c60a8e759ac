#include "WString.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "avr/dtostrf.h"
#include "itoa.h"

namespace {

constexpr size_t DigitsSize = 34;    // of 32 binary digits, and a minus
constexpr size_t DecimalSize = 600;  // of the largest double with 255 decimals; the board has 33, and overflows

}  // namespace

String::String(unsigned char number, unsigned char base) : String(static_cast<unsigned long>(number), base) {}
String::String(int number, unsigned char base) : String(static_cast<long>(number), base) {}
String::String(unsigned number, unsigned char base) : String(static_cast<unsigned long>(number), base) {}

String::String(long number, unsigned char base) {
  char text[DigitsSize];
  concat(ltoa(number, text, base));
}

String::String(unsigned long number, unsigned char base) {
  char text[DigitsSize];
  concat(ultoa(number, text, base));
}

String::String(float number, unsigned char decimals) : String(static_cast<double>(number), decimals) {}

String::String(double number, unsigned char decimals) {
  char text[DecimalSize];
  concat(dtostrf(number, static_cast<signed char>(decimals + 2), decimals, text));
}

String::~String() { free(_text); }

String &String::swap(String &other) {
  char *const text = _text;
  const unsigned length = _length;
  _text = other._text;
  _length = other._length;
  other._text = text;
  other._length = length;
  return *this;
}

bool String::reserve(unsigned size) {
  if (_text != nullptr && size <= _length) {
    return true;
  }
  char *const text = static_cast<char *>(realloc(_text, size_t{size} + 1));
  if (text == nullptr) {
    return false;
  }
  _text = text;
  _text[_length] = '\0';
  return true;
}

bool String::concat(const char *text) { return text != nullptr && concat(text, static_cast<unsigned>(strlen(text))); }

bool String::concat(const char *text, unsigned length) {
  if (text == nullptr) {
    return false;
  }
  const bool own = text == _text;  // s += s
  if (!reserve(_length + length)) {
    return false;
  }
  memmove(_text + _length, own ? _text : text, length);
  _length += length;
  _text[_length] = '\0';
  return true;
}

int String::compareTo(const String &other) const {
  return strcmp(_text == nullptr ? "" : _text, other._text == nullptr ? "" : other._text);
}

bool String::equalsIgnoreCase(const String &other) const {
  String left(*this);
  String right(other);
  left.toLowerCase();
  right.toLowerCase();
  return left == right;
}

bool String::startsWith(const String &prefix, unsigned from) const {
  return prefix._length <= _length && from <= _length - prefix._length && prefix._text != nullptr &&
         strncmp(_text + from, prefix._text, prefix._length) == 0;
}

bool String::endsWith(const String &suffix) const {
  return suffix._length <= _length && startsWith(suffix, _length - suffix._length);
}

char &String::operator[](unsigned index) {
  static char outside;
  outside = '\0';
  return index < _length ? _text[index] : outside;
}

void String::getBytes(unsigned char *bytes, unsigned size, unsigned from) const {
  if (bytes == nullptr || size == 0) {
    return;
  }
  const String part = substring(from);
  const unsigned count = part._length < size ? part._length : size - 1;
  if (count > 0) {
    memcpy(bytes, part._text, count);
  }
  bytes[count] = '\0';
}

int String::indexOf(const String &text, unsigned from) const {
  const char *const found = from < _length && text._text != nullptr ? strstr(_text + from, text._text) : nullptr;
  return found == nullptr ? -1 : static_cast<int>(found - _text);
}

int String::lastIndexOf(const String &text, unsigned from) const {
  if (text._length == 0 || text._length > _length) {
    return -1;
  }
  const unsigned last = _length - text._length;
  for (int index = static_cast<int>(from < last ? from : last); index >= 0; index--) {
    if (startsWith(text, static_cast<unsigned>(index))) {
      return index;
    }
  }
  return -1;
}

String String::substring(unsigned from, unsigned end) const {
  const unsigned low = from < end ? from : end;
  const unsigned high = from < end ? end : from;
  String part;
  if (low < _length) {
    part.concat(_text + low, (high < _length ? high : _length) - low);
  }
  return part;
}

void String::replace(char find, char replacement) {
  for (unsigned i = 0; i < _length; i++) {
    _text[i] = _text[i] == find ? replacement : _text[i];
  }
}

void String::replace(const String &find, const String &replacement) {
  if (_length == 0 || find._length == 0) {
    return;
  }
  String result;
  unsigned from = 0;
  for (int at = indexOf(find); at >= 0; at = indexOf(find, from)) {
    result.concat(_text + from, static_cast<unsigned>(at) - from);
    result.concat(replacement);
    from = static_cast<unsigned>(at) + find._length;
  }
  result.concat(_text + from, _length - from);
  swap(result);
}

void String::remove(unsigned index, unsigned count) {
  if (index < _length) {
    const unsigned gone = count < _length - index ? count : _length - index;
    memmove(_text + index, _text + index + gone, _length - index - gone + 1);
    _length -= gone;
  }
}

void String::toLowerCase() {
  for (unsigned i = 0; i < _length; i++) {
    _text[i] = static_cast<char>(tolower(static_cast<unsigned char>(_text[i])));
  }
}

void String::toUpperCase() {
  for (unsigned i = 0; i < _length; i++) {
    _text[i] = static_cast<char>(toupper(static_cast<unsigned char>(_text[i])));
  }
}

void String::trim() {
  while (_length > 0 && isspace(static_cast<unsigned char>(_text[_length - 1])) != 0) {
    remove(_length - 1);
  }
  unsigned blanks = 0;
  while (blanks < _length && isspace(static_cast<unsigned char>(_text[blanks])) != 0) {
    blanks++;
  }
  remove(0, blanks);
}

// On the board a long has 32 bits, and atol() saturates.
long String::toInt() const {
  const long number = _text == nullptr ? 0 : strtol(_text, nullptr, 10);
  return number < INT32_MIN ? INT32_MIN : number > INT32_MAX ? INT32_MAX : number;
}

double String::toDouble() const { return _text == nullptr ? 0 : strtod(_text, nullptr); }
