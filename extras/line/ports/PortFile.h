// An open serial port of this PC; or a pseudo-terminal, which has no rate and no format.
#pragma once

#include <libserialport.h>

#include <memory>
#include <string>

#include "line/LineSettings.h"

namespace line {

class PortFile {
 public:
  enum class Way { Read, Write };

  // Opens the port with 8 data bits; the polarity is set in the adapter. Throws std::runtime_error, which says what is
  // wrong and what to do.
  PortFile(const std::string &device, const LineSettings &settings, Way way);
  ~PortFile();
  PortFile(const PortFile &) = delete;
  PortFile &operator=(const PortFile &) = delete;

  // Returns the file descriptor; its read() and write() never wait.
  int file() const { return _file; }

 private:
  struct Close {
    void operator()(sp_port *port) const;
  };

  std::unique_ptr<sp_port, Close> _port;  // null for a pseudo-terminal
  int _file = -1;
};

}  // namespace line
