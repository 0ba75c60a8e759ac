#include "line/ports/PortFile.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>

namespace line {

namespace {

std::string lastError() {
  char *const message = sp_last_error_message();
  const std::string text = message != nullptr && message[0] != '\0' ? message : "not supported";
  sp_free_error_message(message);
  return text;
}

bool configure(sp_port *port, const LineSettings &settings) {
  const sp_parity parities[] = {SP_PARITY_NONE, SP_PARITY_EVEN, SP_PARITY_ODD};
  return sp_set_baudrate(port, static_cast<int>(settings.baud)) == SP_OK && sp_set_bits(port, 8) == SP_OK &&
         sp_set_parity(port, parities[static_cast<int>(settings.format.parity)]) == SP_OK &&
         sp_set_stopbits(port, static_cast<int>(settings.format.stopBits)) == SP_OK &&
         sp_set_flowcontrol(port, SP_FLOWCONTROL_NONE) == SP_OK;
}

// Returns true if the port runs at this rate: some drivers accept any rate, but use the nearest one that they support.
bool runsAt(sp_port *port, int wanted) {
  sp_port_config *config = nullptr;
  int baud = 0;
  if (sp_new_config(&config) != SP_OK) {
    return false;
  }
  const bool known = sp_get_config(port, config) == SP_OK && sp_get_config_baudrate(config, &baud) == SP_OK;
  sp_free_config(config);
  return known && std::abs(baud - wanted) <= wanted / 50;  // 2 %: the tolerance of 12 bits
}

}  // namespace

PortFile::PortFile(const std::string &device, const LineSettings &settings, Way way) {
  std::error_code error;
  if (isPseudoTerminal(device) || isPseudoTerminal(std::filesystem::canonical(device, error).string())) {
    openPseudoTerminal(device, way);
    return;
  }
  sp_port *port = nullptr;
  if (sp_get_port_by_name(device.c_str(), &port) != SP_OK) {
    throw std::runtime_error(openError(device, 0, "unknown to the system"));
  }
  _port.reset(port);
  // A port to write to is also opened for reading: otherwise Windows does not return its settings.
  if (sp_open(port, way == Way::Read ? SP_MODE_READ : SP_MODE_READ_WRITE) != SP_OK) {
    const int number = sp_last_error_code();
    throw std::runtime_error(openError(device, number, lastError()));
  }
  if (!configure(port, settings) || !runsAt(port, static_cast<int>(settings.baud))) {
    LineSettings wanted = settings;
    wanted.polarity = Polarity::Either;
    throw std::runtime_error(device + ": this adapter cannot do " + text(wanted) +
                             "; use one that can, such as FTDI's");
  }
}

PortFile::~PortFile() {
  if (!_port) {
    close(_file);
  }
}

bool PortFile::holdsBytes() { return _port ? sp_output_waiting(_port.get()) > 0 : _unread && _unread->waits(); }

void PortFile::discard() {
  if (_port) {
    sp_flush(_port.get(), SP_BUF_OUTPUT);
  }
}

void PortFile::Close::operator()(sp_port *port) const {
  sp_close(port);  // sp_free_port() leaves it open
  sp_free_port(port);
}

}  // namespace line
