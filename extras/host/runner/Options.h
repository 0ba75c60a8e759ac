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

// Records what `port` sends in a file.
struct SentOption {
  int port;
  std::string file;
};

struct Options {
  line::Source source;
  std::string port;  // the source's name if it is a port; otherwise empty
  int on = 1;        // 0: no line, since a wire replaces it
  std::vector<WireOption> wires;
  std::vector<SentOption> sent;
  bool pulses = false;  // a receiver without S.Bus is connected to pins 2..5
  std::string eeprom;   // a file's name, or empty
  double seconds = 0;   // 0: until the line ends
  bool simulatedTime = false;
  uint32_t loopUs = 50;
  uint32_t startMs = 0;
  bool pty = false;
};

// Reads the command line. Ends the program if it is wrong or asks for help.
Options parseOptions(int argc, char **argv);

}  // namespace host
