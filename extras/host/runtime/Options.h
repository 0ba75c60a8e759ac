// The command line.
#pragma once

#include <cstdint>
#include <string>

#include "sbus/Frame.h"

namespace host {

struct Options {
  std::string recording;  // a file's name, or empty
  std::string port;       // a device's name, or empty
  unsigned long lineBaud = sbus::Baud;
  bool uninverted = false;
  unsigned noise = 0;  // disturbances per second
  bool silent = false;
  int on = 1;
  double seconds = 0;  // 0: as long as there is something to come
  bool simulatedTime = false;
  uint32_t loopUs = 50;
  uint32_t startMs = 0;
  bool pty = false;
};

// Reads the command line. Ends the program if it asks for help or is wrong.
Options parseOptions(int argc, char **argv);

}  // namespace host
