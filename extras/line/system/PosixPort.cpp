#if !defined(_WIN32)

#include <fcntl.h>
#include <grp.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>
#if defined(__APPLE__)
#include <IOKit/serial/ioss.h>
#endif

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "line/ports/PortFile.h"
#include "line/system/System.h"

namespace line {

namespace {

// Returns how to get permission: a port belongs to a group, "dialout" on Debian, "uucp" on Arch.
std::string permissionRemedy(const std::string &device, const struct stat &status) {
  const group *const owners = (status.st_mode & S_IRGRP) != 0 ? getgrgid(status.st_gid) : nullptr;
  if (owners == nullptr || status.st_gid == 0) {
    const std::string name = device.substr(device.rfind('/') + 1);
    return "a udev rule gives it: SUBSYSTEM==\"tty\", KERNEL==\"" + name +
           "\", MODE=\"0666\" in /etc/udev/rules.d/99-sbus.rules, then plug it in again";
  }
  return std::string("join the group that may use it (sudo usermod -aG ") + owners->gr_name + " $USER), log in again";
}

}  // namespace

std::string openError(const std::string &device, int error, const std::string &message) {
  struct stat status;
  if (stat(device.c_str(), &status) != 0 && errno == ENOENT) {
    return device + ": there is no such port; plug the adapter in and look for its name in " + PortsPlace;
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

void PortFile::openPseudoTerminal(const std::string &device, Way way) {
  _file = open(device.c_str(), (way == Way::Read ? O_RDONLY : O_WRONLY) | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  termios settings;
  if (_file < 0 || tcgetattr(_file, &settings) != 0) {
    throw std::runtime_error(openError(device, errno, std::strerror(errno)));
  }
  if (way == Way::Read && flock(_file, LOCK_EX | LOCK_NB) != 0) {  // two readers would get half of the bytes each
    close(_file);
    throw std::runtime_error(openError(device, EBUSY, ""));
  }
  cfmakeraw(&settings);
  tcsetattr(_file, TCSANOW, &settings);
  if (way == Way::Write) {
    _unread.emplace(_file);
  }
}

int PortFile::file() const {
  int file = _file;
  if (_port) {
    sp_get_port_handle(_port.get(), &file);
  }
  return file;
}

// libserialport does not check parity.
bool PortFile::markErrors() {
  termios settings;
  if (tcgetattr(file(), &settings) != 0) {
    return false;
  }
  settings.c_iflag &= ~static_cast<tcflag_t>(IGNPAR | IGNBRK | BRKINT);
  settings.c_iflag |= INPCK | PARMRK;
#if defined(__APPLE__)  // its tcsetattr() accepts only standard rates
  speed_t baud = cfgetispeed(&settings);
  cfsetspeed(&settings, B9600);
#endif
  bool done = tcsetattr(file(), TCSANOW, &settings) == 0;
#if defined(__APPLE__)
  done = done && (!_port || ioctl(file(), IOSSIOSPEED, &baud) == 0);
#endif
  tcflush(file(), TCIFLUSH);
  return done;
}

// A read returns the same on a lost port and on a silent one, but only the silent one is not readable.
std::ptrdiff_t PortFile::read(uint8_t *bytes, size_t size) {
  const ssize_t count = ::read(file(), bytes, size);
  if (count > 0) {
    return count;
  }
  int came = 0;
  const bool failed = count < 0 && errno != EAGAIN && errno != EINTR;
  return failed || (isReadable(file(), 0) && (ioctl(file(), FIONREAD, &came) != 0 || came == 0)) ? -1 : 0;
}

std::ptrdiff_t PortFile::write(const uint8_t *bytes, size_t size) {
  const ssize_t count = ::write(file(), bytes, size);
  if (_unread && count > 0) {
    _unread->wrote();
  }
  return count >= 0 ? count : errno == EAGAIN || errno == EINTR ? 0 : -1;
}

void PortFile::wait(int ms) { isReadable(file(), ms); }

}  // namespace line

#endif
