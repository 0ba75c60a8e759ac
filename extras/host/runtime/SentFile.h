// What a sketch has sent, written down as a recording (see Recording.h).
#pragma once

#include <cstdint>
#include <fstream>
#include <string>

#include "Line.h"
#include "PortSettings.h"

namespace host {

class SentFile {
 public:
  explicit SentFile(const std::string &name);  // throws std::runtime_error

  // The port was opened: a comment says so. Characters take so long from now on.
  void opened(const PortSettings &settings);

  void look(const Character &character);

  // Ends the last line. Returns what has gone wrong, or nothing.
  std::string finish();

 private:
  void endLine();

  std::string _name;
  std::ofstream _file;
  PortSettings _settings;
  uint32_t _characterUs = CharacterUs;
  uint64_t _lastEndUs = 0;
  unsigned _onLine = 0;  // characters of the line that is not yet complete
};

}  // namespace host
