// Scans a small language on the command line, for example --mix, and reports where it is wrong.
#pragma once

#include <cstdint>
#include <string>

#include "sbus/Scaling.h"

namespace tool {

class Scanner {
 public:
  // Messages begin with `option`.
  Scanner(const char *option, const std::string &text) : _option(option), _text(text) {}

  // Takes a sign or word, and blanks before it. Returns false if something else is next.
  bool take(const char *token);

  // Takes letters and digits, and returns them in lower case; "" if none are next.
  std::string word();

  // Takes a number such as 0.5. Returns false if none is next.
  bool number(double &value);

  // Takes a channel, ch1 to ch`most`; rejects the command line if none is next.
  unsigned channel(unsigned most);

  // Takes a channel's value, 1500, 1500us or -50%; rejects the command line if none is next.
  uint16_t value(const sbus::Range &range);

  // Rejects the command line: `what` is expected in place of the last word, number or value, or at the current place.
  [[noreturn]] void expect(const std::string &what);

  // Rejects the command line unless the text ends here.
  void end(const std::string &what);

 private:
  void skipBlanks();
  std::string digits();

  const char *const _option;
  const std::string _text;
  size_t _at = 0;     // the next character
  size_t _begin = 0;  // where the last token began
};

}  // namespace tool
