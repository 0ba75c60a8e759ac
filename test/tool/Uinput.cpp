// A stand-in for libevdev's uinput devices, for a machine without /dev/uinput: LD_PRELOAD it. It drops the same events
// as Linux 6.1; the comments name the lines of drivers/input/input.c.
//
//   UINPUT_LOG     what a program that reads the event device would see, a report a line: "ABS_X=12 BTN_EAST=1"; the
//                  device with its axes when it is created and when it is destroyed; events that the kernel ignores
//                  without an error, as "dropped"; and "unread" if the device is destroyed before a game that reads 30
//                  times a second got the newest report
//   UINPUT_ERRNO   a device cannot be created: the error of open("/dev/uinput")
#include <libevdev/libevdev-uinput.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <utility>

struct libevdev_uinput {
  std::map<std::pair<unsigned, unsigned>, int> values;  // of the codes that were set
  size_t axes = 0;
  std::string report;
  size_t events = 0;                                    // in the report
  std::chrono::steady_clock::time_point reportTime{};  // of the newest
};

namespace {

constexpr std::chrono::milliseconds ReadEvery(33);

void log(const std::string &line) {
  FILE *const file = std::fopen(std::getenv("UINPUT_LOG"), "a");
  std::fprintf(file, "%s\n", line.c_str());
  std::fclose(file);
}

std::string named(unsigned type, unsigned code, int value) {
  const char *const name = libevdev_event_code_get_name(type, code);
  return (name != nullptr ? name : std::to_string(type) + ":" + std::to_string(code)) + "=" + std::to_string(value);
}

void flush(libevdev_uinput &device) {  // 372: SYN_REPORT alone is not a report
  log(device.events == 0 ? "dropped: SYN_REPORT without an event" : device.report);
  device.reportTime = std::chrono::steady_clock::now();
  device.report.clear();
  device.events = 0;
}

}  // namespace

extern "C" {

int libevdev_uinput_create_from_device(const libevdev *plan, int, libevdev_uinput **created) {
  if (const char *const error = std::getenv("UINPUT_ERRNO")) {
    return -std::atoi(error);
  }
  const auto device = new libevdev_uinput;
  std::string line = std::string("created \"") + libevdev_get_name(plan) + "\"";
  for (unsigned code = 0; code < ABS_CNT; code++) {
    const input_absinfo *const axis = libevdev_get_abs_info(plan, code);
    if (axis != nullptr) {
      device->values[{EV_ABS, code}] = axis->value;
      line += " " + named(EV_ABS, code, axis->value) + " of " + std::to_string(axis->minimum) + ".." +
              std::to_string(axis->maximum) + (axis->fuzz != 0 || axis->flat != 0 ? " with a dead zone" : "");
    }
  }
  device->axes = device->values.size();
  for (unsigned code = 0; code < KEY_CNT; code++) {
    if (libevdev_has_event_code(plan, EV_KEY, code) != 0) {
      device->values[{EV_KEY, code}] = 0;
    }
  }
  log(line + " buttons: " + std::to_string(device->values.size() - device->axes));
  *created = device;
  return 0;
}

int libevdev_uinput_write_event(const libevdev_uinput *constDevice, unsigned type, unsigned code, int value) {
  libevdev_uinput &device = *const_cast<libevdev_uinput *>(constDevice);
  const std::string text = named(type, code, value);
  const auto old = device.values.find({type, code});
  if (type == EV_SYN && code == SYN_REPORT) {
    flush(device);
  } else if (old == device.values.end()) {  // 428, 265, 291
    log("dropped: " + text + " was never set");
  } else if (old->second == value) {  // 222, 273
    log("dropped: " + text + " is as it was");
  } else {
    old->second = value;
    device.report += (device.report.empty() ? "" : " ") + text;
    if (++device.events >= device.axes + 8) {  // 383, 2253: more than these do not fit into a report
      flush(device);
    }
  }
  return 0;
}

// Nothing can be read from a device that is gone, not even waiting events: drivers/input/evdev.c, evdev_read(); so for
// joydev.c, joydev_read().
void libevdev_uinput_destroy(libevdev_uinput *device) {
  if (std::chrono::steady_clock::now() - device->reportTime < ReadEvery) {
    log("unread: the newest report");
  }
  log("destroyed");
  delete device;
}

const char *libevdev_uinput_get_devnode(libevdev_uinput *) {
  return nullptr;
}

const char *libevdev_uinput_get_syspath(libevdev_uinput *) {
  return "/sys/devices/virtual/input/input4294967295";
}

}  // extern "C"
