#include "Stream.h"

uint32_t millis();

// Calls read() or peek() until it returns a byte; a negative number: not within the timeout.
int Stream::timed(int (Stream::*next)()) {
  const uint32_t startMs = millis();
  int byte = (this->*next)();
  while (byte < 0 && millis() - startMs < _timeout) {
    byte = (this->*next)();
  }
  return byte;
}

size_t Stream::readUpTo(int end, uint8_t *buffer, size_t size) {
  size_t count = 0;
  for (int next = 0; count < size && (next = timedRead()) >= 0 && next != end; count++) {
    buffer[count] = static_cast<uint8_t>(next);
  }
  return count;
}

String Stream::readUpTo(int end) {
  String text;
  for (int next = timedRead(); next >= 0 && next != end; next = timedRead()) {
    text += static_cast<char>(next);
  }
  return text;
}

// A minus counts only in front, a point only once and only if `point`.
double Stream::parseNumber(bool point) {
  int next = timedPeek();
  while (next >= 0 && next != '-' && isdigit(next) == 0 && !(point && next == '.')) {
    read();
    next = timedPeek();
  }
  const bool negative = next == '-';
  double number = 0;
  double place = 0;  // of the next digit after the point; 0 before it
  do {
    if (next == '.') {
      place = 0.1;
    } else if (next >= 0 && next != '-') {
      const int digit = next - '0';
      number = place == 0 ? number * 10 + digit : number + digit * place;
      place /= 10;
    }
    read();
    next = timedPeek();
  } while (next >= 0 && (isdigit(next) != 0 || (point && next == '.' && place == 0)));
  return negative ? -number : number;
}

long Stream::parseInt() { return static_cast<long>(parseNumber(false)); }

float Stream::parseFloat() { return static_cast<float>(parseNumber(true)); }

bool Stream::find(char c) {
  const char text[] = {c, '\0'};
  return find(text);
}

bool Stream::findUntil(const char *text, const char *terminator) {
  String read;
  const auto found = [&read](const char *end) { return end != nullptr && read.endsWith(end); };
  for (int next = 0; !found(text); read += static_cast<char>(next)) {
    next = found(terminator) ? -1 : timedRead();
    if (next < 0) {
      return false;
    }
  }
  return true;
}
