// The command line.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "line/Source.h"

namespace host {

// A wire from the TX pin of port `from` to the RX pin of port `to`.
struct WireOption {
  int from;
  int to;
};

// What port `port` sends goes into this file.
struct SentOption {
  int port;
  std::string file;
};

struct Options {
  line::Source source;
  std::string port;  // the name of the source if it is a port; or empty
  int on = 1;        // 0: there is no line, a wire has replaced it
  std::vector<WireOption> wires;
  std::vector<SentOption> sent;
  bool pulses = false;  // a receiver without S.Bus is connected to the pins 2..5
  std::string eeprom;   // a file's name, or empty
  double seconds = 0;   // 0: until the line has ended
  bool simulatedTime = false;
  uint32_t loopUs = 50;
  uint32_t startMs = 0;
  bool pty = false;
};

// Reads the command line. Ends the program if the line is wrong, or asks for help.
Options parseOptions(int argc, char **argv);

}  // namespace host
