// A port gets low latency while it is open, and its own setting back.
#include "line/ports/LowLatency.h"

#include <doctest/doctest.h>
#include <linux/serial.h>
#include <sys/ioctl.h>

#include <cerrno>
#include <cstdarg>

using line::LowLatency;

namespace {

// Answers as Linux does, usb-serial.c, serial_ioctl(), and ftdi_sio.c, get_serial_info() and set_serial_info(): users
// other than root may change the flags of ASYNC_USR_MASK only, and a terminal that is no serial port has neither
// request (ENOTTY).
struct Driver {
  bool isSerial = true;
  int setError = 0;
  int flags = ASYNC_SKIP_TEST;
  int sets = 0;
};
Driver driver;

int control(int, unsigned long request, ...) {
  va_list arguments;
  va_start(arguments, request);
  serial_struct *const settings = va_arg(arguments, serial_struct *);
  va_end(arguments);
  if (!driver.isSerial) {
    errno = ENOTTY;
    return -1;
  }
  if (request == TIOCGSERIAL) {
    settings->flags = driver.flags;
    return 0;
  }
  driver.sets++;
  if (driver.setError != 0 || ((settings->flags ^ driver.flags) & ~static_cast<int>(ASYNC_USR_MASK)) != 0) {
    errno = driver.setError != 0 ? driver.setError : EPERM;
    return -1;
  }
  driver.flags = settings->flags;
  return 0;
}

}  // namespace

TEST_CASE("a port has low latency while it is open; what other programs set meanwhile stays") {
  driver = Driver();
  {
    const LowLatency latency(3, control);
    CHECK(driver.flags == (ASYNC_SKIP_TEST | ASYNC_LOW_LATENCY));
    driver.flags |= ASYNC_SPD_VHI;
  }
  CHECK(driver.flags == (ASYNC_SKIP_TEST | ASYNC_SPD_VHI));
}

TEST_CASE("a port that has low latency already keeps it") {
  driver = Driver();
  driver.flags |= ASYNC_LOW_LATENCY;
  { const LowLatency latency(3, control); }
  CHECK(driver.flags == (ASYNC_SKIP_TEST | ASYNC_LOW_LATENCY));
  CHECK(driver.sets == 0);
}

TEST_CASE("if that is not allowed, or the port is no serial port, nothing changes") {
  driver = Driver();
  driver.setError = EPERM;
  { const LowLatency latency(3, control); }
  CHECK(driver.sets == 1);
  CHECK(driver.flags == ASYNC_SKIP_TEST);
  driver = Driver();
  driver.isSerial = false;
  { const LowLatency latency(3, control); }
  CHECK(driver.sets == 0);
}

TEST_CASE("the file of an adapter's latency timer is found, also by a link to the port") {
  CHECK(line::latencyFile("/dev/ttyUSB7") == "/sys/bus/usb-serial/devices/ttyUSB7/latency_timer");
  CHECK(line::latencyFile("/dev/fd/../null") == "/sys/bus/usb-serial/devices/null/latency_timer");
  CHECK(line::latencyMs("/proc/sys/kernel/pid_max").value_or(0) > 0);
  CHECK_FALSE(line::latencyMs("/no/such/file"));
}
