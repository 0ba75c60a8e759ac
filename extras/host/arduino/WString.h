// String: text on the heap, like the cores' (GrumpyOldPizza/ArduinoCore-stm32l0 and arduino/ArduinoCore-avr,
// cores/arduino/WString.h), quirks included: String(5.0, 0) is " 5", String(255, HEX) is "ff".
#pragma once

#include <ctype.h>
#include <stddef.h>

// F("text") only marks its text to select a separate overload, as on the board.
class __FlashStringHelper;
#define F(text) (reinterpret_cast<const __FlashStringHelper *>(text))

class String {
 public:
  String(const char *text = "") { concat(text); }
  String(const __FlashStringHelper *text) { concat(text); }
  String(const String &other) { concat(other); }
  String(String &&other) : String() { swap(other); }
  explicit String(char c) { concat(c); }
  explicit String(unsigned char number, unsigned char base = 10);
  explicit String(int number, unsigned char base = 10);
  explicit String(unsigned number, unsigned char base = 10);
  explicit String(long number, unsigned char base = 10);
  explicit String(unsigned long number, unsigned char base = 10);
  explicit String(float number, unsigned char decimals = 2);
  explicit String(double number, unsigned char decimals = 2);
  ~String();

  String &operator=(const String &other) {
    String copy(other);
    return swap(copy);
  }
  String &operator=(String &&other) { return swap(other); }
  String &operator=(const char *text) { return *this = String(text); }
  String &operator=(const __FlashStringHelper *text) { return *this = String(text); }

  unsigned length() const { return _length; }
  const char *c_str() const { return _text; }
  char *begin() { return _text; }
  char *end() { return _text + _length; }
  const char *begin() const { return _text; }
  const char *end() const { return _text + _length; }
  bool reserve(unsigned size);
  explicit operator bool() const { return _text != nullptr; }  // true also for an empty String

  // Append. Return false for a null pointer.
  bool concat(const String &other) { return concat(other._text, other._length); }
  bool concat(const char *text);
  bool concat(const char *text, unsigned length);
  bool concat(const __FlashStringHelper *text) { return concat(reinterpret_cast<const char *>(text)); }
  bool concat(char c) { return concat(&c, 1); }
  bool concat(unsigned char number) { return concat(String(number)); }
  bool concat(int number) { return concat(String(number)); }
  bool concat(unsigned number) { return concat(String(number)); }
  bool concat(long number) { return concat(String(number)); }
  bool concat(unsigned long number) { return concat(String(number)); }
  bool concat(float number) { return concat(String(number)); }
  bool concat(double number) { return concat(String(number)); }
  template <typename T>
  String &operator+=(const T &value) {
    concat(value);
    return *this;
  }

  int compareTo(const String &other) const;
  bool equals(const String &other) const { return compareTo(other) == 0; }
  bool equalsIgnoreCase(const String &other) const;
  bool operator==(const String &other) const { return equals(other); }
  bool operator!=(const String &other) const { return !equals(other); }
  bool operator<(const String &other) const { return compareTo(other) < 0; }
  bool operator>(const String &other) const { return compareTo(other) > 0; }
  bool operator<=(const String &other) const { return compareTo(other) <= 0; }
  bool operator>=(const String &other) const { return compareTo(other) >= 0; }
  bool startsWith(const String &prefix, unsigned from = 0) const;
  bool endsWith(const String &suffix) const;

  // Outside the text they read as 0, and ignore writes.
  char charAt(unsigned index) const { return (*this)[index]; }
  void setCharAt(unsigned index, char c) { (*this)[index] = c; }
  char operator[](unsigned index) const { return index < _length ? _text[index] : '\0'; }
  char &operator[](unsigned index);
  void getBytes(unsigned char *bytes, unsigned size, unsigned from = 0) const;
  void toCharArray(char *text, unsigned size, unsigned from = 0) const {
    getBytes(reinterpret_cast<unsigned char *>(text), size, from);
  }

  // Return the index of the first or the last occurrence; -1 without one.
  int indexOf(char c, unsigned from = 0) const { return indexOf(String(c), from); }
  int indexOf(const String &text, unsigned from = 0) const;
  int lastIndexOf(char c) const { return lastIndexOf(String(c)); }
  int lastIndexOf(char c, unsigned from) const { return from < _length ? lastIndexOf(String(c), from) : -1; }
  int lastIndexOf(const String &text) const { return lastIndexOf(text, _length - text._length); }
  int lastIndexOf(const String &text, unsigned from) const;
  String substring(unsigned from) const { return substring(from, _length); }
  String substring(unsigned from, unsigned end) const;

  void replace(char find, char replacement);
  void replace(const String &find, const String &replacement);
  void remove(unsigned index) { remove(index, _length); }
  void remove(unsigned index, unsigned count);
  void toLowerCase();
  void toUpperCase();
  void trim();

  // Return 0 if there is no number at the beginning.
  long toInt() const;
  float toFloat() const { return static_cast<float>(toDouble()); }
  double toDouble() const;

 private:
  String &swap(String &other);

  char *_text = nullptr;  // null: the text was a null pointer
  unsigned _length = 0;
};

// The left operand of a +: a String, or something convertible to one.
class StringSumHelper : public String {
 public:
  StringSumHelper(const String &text) : String(text) {}
  StringSumHelper(const char *text) : String(text) {}
  StringSumHelper(const __FlashStringHelper *text) : String(text) {}
  StringSumHelper(char c) : String(c) {}
  StringSumHelper(unsigned char number) : String(number) {}
  StringSumHelper(int number) : String(number) {}
  StringSumHelper(unsigned number) : String(number) {}
  StringSumHelper(long number) : String(number) {}
  StringSumHelper(unsigned long number) : String(number) {}
  StringSumHelper(float number) : String(number) {}
  StringSumHelper(double number) : String(number) {}

  template <typename T>
  StringSumHelper plus(T value) const {
    StringSumHelper sum(*this);
    sum += value;
    return sum;
  }
};

inline StringSumHelper operator+(const StringSumHelper &left, const String &right) {
  return left.plus<const String &>(right);
}
inline StringSumHelper operator+(const StringSumHelper &left, const char *right) { return left.plus(right); }
inline StringSumHelper operator+(const StringSumHelper &left, const __FlashStringHelper *right) {
  return left.plus(right);
}
inline StringSumHelper operator+(const StringSumHelper &left, char right) { return left.plus(right); }
inline StringSumHelper operator+(const StringSumHelper &left, unsigned char right) { return left.plus(right); }
inline StringSumHelper operator+(const StringSumHelper &left, int right) { return left.plus(right); }
inline StringSumHelper operator+(const StringSumHelper &left, unsigned right) { return left.plus(right); }
inline StringSumHelper operator+(const StringSumHelper &left, long right) { return left.plus(right); }
inline StringSumHelper operator+(const StringSumHelper &left, unsigned long right) { return left.plus(right); }
inline StringSumHelper operator+(const StringSumHelper &left, float right) { return left.plus(right); }
inline StringSumHelper operator+(const StringSumHelper &left, double right) { return left.plus(right); }
