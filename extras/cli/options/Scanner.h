// Reads a small language on the command line, such as that of --mix, and names the place of what is wrong.
#pragma once

#include <cstdint>
#include <string>

#include "sbus/Scaling.h"

namespace tool {

class Scanner {
 public:
  // `option` is what a message begins with.
  Scanner(const char *option, const std::string &text) : _option(option), _text(text) {}

  // Takes a sign or word, and blanks before it. Returns false if something different is next.
  bool take(const char *token);

  // Takes letters and digits, in small letters; returns "" where none are next.
  std::string word();

  // Takes a number such as 0.5. Returns false if none is next.
  bool number(double &value);

  // Takes a channel, ch1 to ch`most`; rejects the command line if none is next.
  unsigned channel(unsigned most);

  // Takes a channel's value, 1500, 1500us or -50%; rejects the command line if none is next.
  uint16_t value(const sbus::Range &range);

  // Rejects the command line: `what` is expected at the place of the last word, number or value, or of what is next.
  [[noreturn]] void expect(const std::string &what);

  // Rejects the command line unless the text ends here.
  void end(const std::string &what);

 private:
  void skipBlanks();
  std::string digits();

  const char *const _option;
  const std::string _text;
  size_t _at = 0;     // of what is next
  size_t _begin = 0;  // of what was taken last
};

}  // namespace tool
