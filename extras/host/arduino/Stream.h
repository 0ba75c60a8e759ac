#pragma once

#include "Print.h"

class Stream : public Print {
 public:
  virtual int available() = 0;
  virtual int read() = 0;
  virtual int peek() = 0;

  // How long the methods below wait for the next byte, in ms.
  void setTimeout(unsigned long ms) { _timeout = ms; }
  unsigned long getTimeout() const { return _timeout; }

  // Reads up to `size` bytes, or to the terminator, which is removed and not counted. Returns the number of bytes.
  size_t readBytes(uint8_t *buffer, size_t size) { return readUpTo(NoEnd, buffer, size); }
  size_t readBytes(char *buffer, size_t size) { return readBytes(reinterpret_cast<uint8_t *>(buffer), size); }
  size_t readBytesUntil(char terminator, uint8_t *buffer, size_t size) {
    return readUpTo(static_cast<uint8_t>(terminator), buffer, size);
  }
  size_t readBytesUntil(char terminator, char *buffer, size_t size) {
    return readBytesUntil(terminator, reinterpret_cast<uint8_t *>(buffer), size);
  }
  String readString() { return readUpTo(NoEnd); }
  String readStringUntil(char terminator) { return readUpTo(static_cast<uint8_t>(terminator)); }

  // Skip to the first digit or minus, and read the number. The rest stays. Return 0 without a number.
  long parseInt();
  float parseFloat();

  // Read up to the end of `text`. Return false after the timeout, or if the terminator comes first.
  bool find(const char *text) { return findUntil(text, nullptr); }
  bool find(char c);
  bool findUntil(const char *text, const char *terminator);

 private:
  static constexpr int NoEnd = -1;

  int timed(int (Stream::*next)());
  int timedRead() { return timed(&Stream::read); }
  int timedPeek() { return timed(&Stream::peek); }
  size_t readUpTo(int end, uint8_t *buffer, size_t size);
  String readUpTo(int end);
  double parseNumber(bool point);

  unsigned long _timeout = 1000;
};
