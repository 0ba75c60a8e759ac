#include "line/ports/PortFile.h"

#include <fcntl.h>
#include <grp.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

namespace line {

namespace {

std::string lastError() {
  char *const message = sp_last_error_message();
  const std::string text = message != nullptr && message[0] != '\0' ? message : "not supported";
  sp_free_error_message(message);
  return text;
}

// Returns how to get the permission: a port belongs to a group, "dialout" on Debian, "uucp" on Arch.
std::string permissionRemedy(const std::string &device, const struct stat &status) {
  const group *const owners = (status.st_mode & S_IRGRP) != 0 ? getgrgid(status.st_gid) : nullptr;
  if (owners == nullptr || status.st_gid == 0) {
    const std::string name = device.substr(device.rfind('/') + 1);
    return "a udev rule gives it: SUBSYSTEM==\"tty\", KERNEL==\"" + name +
           "\", MODE=\"0666\" in /etc/udev/rules.d/99-sbus.rules, then plug it in again";
  }
  return std::string("join the group that may use it (sudo usermod -aG ") + owners->gr_name + " $USER), log in again";
}

// Returns why `device` could not be opened. `error`, `message`: the system's.
std::string openError(const std::string &device, int error, const std::string &message) {
  struct stat status;
  if (stat(device.c_str(), &status) != 0 && errno == ENOENT) {
    return device + ": there is no such port; plug the adapter in and look for its name in /dev/serial/by-id";
  }
  switch (error) {
    case EACCES:
      return device + ": no permission; " + permissionRemedy(device, status);
    case EBUSY:
      return device + ": in use; close the other program that has it open";
    default:
      return device + ": not a serial port that can be opened (" + message + "); name the adapter's port";
  }
}

bool configure(sp_port *port, const LineSettings &settings) {
  const sp_parity parities[] = {SP_PARITY_NONE, SP_PARITY_EVEN, SP_PARITY_ODD};
  return sp_set_baudrate(port, static_cast<int>(settings.baud)) == SP_OK && sp_set_bits(port, 8) == SP_OK &&
         sp_set_parity(port, parities[static_cast<int>(settings.format.parity)]) == SP_OK &&
         sp_set_stopbits(port, static_cast<int>(settings.format.stopBits)) == SP_OK &&
         sp_set_flowcontrol(port, SP_FLOWCONTROL_NONE) == SP_OK;
}

// Returns true if the port runs at this rate: some drivers accept any rate, and run at the nearest one that they have.
bool runsAt(sp_port *port, int wanted) {
  sp_port_config *config = nullptr;
  int baud = 0;
  if (sp_new_config(&config) != SP_OK) {
    return false;
  }
  const bool known = sp_get_config(port, config) == SP_OK && sp_get_config_baudrate(config, &baud) == SP_OK;
  sp_free_config(config);
  return known && std::abs(baud - wanted) <= wanted / 50;  // 2 %: what 12 bits can bear
}

// Returns true for a pseudo-terminal, which libserialport does not know.
bool isPseudoTerminal(const std::string &device) {
  constexpr unsigned First = 136;  // major numbers of Linux
  constexpr unsigned Last = 143;
  struct stat status;
  return stat(device.c_str(), &status) == 0 && S_ISCHR(status.st_mode) && major(status.st_rdev) >= First &&
         major(status.st_rdev) <= Last;
}

int openPseudoTerminal(const std::string &device, int flags) {
  const int file = open(device.c_str(), flags | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  termios settings;
  if (file < 0 || tcgetattr(file, &settings) != 0) {
    throw std::runtime_error(openError(device, errno, std::strerror(errno)));
  }
  if (flags == O_RDONLY && flock(file, LOCK_EX | LOCK_NB) != 0) {  // two readers would have half of the bytes each
    close(file);
    throw std::runtime_error(openError(device, EBUSY, ""));
  }
  cfmakeraw(&settings);
  tcsetattr(file, TCSANOW, &settings);
  return file;
}

}  // namespace

PortFile::PortFile(const std::string &device, const LineSettings &settings, Way way) {
  if (isPseudoTerminal(device)) {
    _file = openPseudoTerminal(device, way == Way::Read ? O_RDONLY : O_WRONLY);
    return;
  }
  sp_port *port = nullptr;
  if (sp_get_port_by_name(device.c_str(), &port) != SP_OK) {
    throw std::runtime_error(openError(device, 0, "unknown to the system"));
  }
  _port.reset(port);
  if (sp_open(port, way == Way::Read ? SP_MODE_READ : SP_MODE_WRITE) != SP_OK) {
    const int error = sp_last_error_code();
    throw std::runtime_error(openError(device, error, lastError()));
  }
  if (!configure(port, settings) || !runsAt(port, static_cast<int>(settings.baud)) ||
      sp_get_port_handle(port, &_file) != SP_OK) {
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

void PortFile::Close::operator()(sp_port *port) const {
  sp_close(port);  // sp_free_port() leaves it open
  sp_free_port(port);
}

}  // namespace line
