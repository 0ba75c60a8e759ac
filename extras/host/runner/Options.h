// The command line, and what is made of it: the line before the run, and the report after it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "line/Source.h"

namespace host {

class Board;

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
  std::string port;                    // the source's name if it is a port; otherwise empty
  int on = 1;                          // 0: no line, since a wire replaces it
  std::optional<line::Source> second;  // of another line, which is attached to Serial2
  std::vector<WireOption> wires;
  std::vector<SentOption> sent;
  bool pulses = false;  // a receiver without S.Bus is connected to pins 2..5
  double seconds = 0;   // 0: until the line ends
  bool simulatedTime = false;
  uint32_t loopUs = 50;
};

// Reads the command line. Ends the program if it is wrong or asks for help.
Options parseOptions(int argc, char **argv);

// The port of the second line.
constexpr int SecondPort = 2;

// Opens the line for the board's port, and prints its name to standard error; a silent line if the options have none.
// Throws std::runtime_error.
std::unique_ptr<line::Line> makeLine(const Options &options);

// Opens the second line likewise; null without one.
std::unique_ptr<line::Line> makeSecondLine(const Options &options);

// Prints the report at the end, on standard error.
void printReport(Board &board, const Options &options);

}  // namespace host
