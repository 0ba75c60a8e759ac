// The runner's command line. Where the host has the same option, it means the same.
#pragma once

#include <string>

#include "line/Source.h"

namespace mega {

struct Options {
  std::string elf;
  line::Source source;
  int wireFrom = 0;    // the USART that is wired to RX of USART1, or 0
  double seconds = 0;  // 0: as long as there is something to come
  long bad = -1;       // number of a character, or -1
  double cut = 0;      // s; 0: not at all
  bool anySettings = false;
  bool frames = false;
  std::string eeprom;  // a file's name, or empty
};

// Ends the program if it asks for help or is wrong.
Options parseOptions(int argc, char **argv);

}  // namespace mega
