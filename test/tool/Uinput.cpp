// A stand-in for /dev/uinput, for a machine without one: LD_PRELOAD it. It accepts, rejects and drops the same as Linux
// 6.1; the comments name the lines of drivers/input/misc/uinput.c, and of drivers/input/input.c as "input.c".
//
//   UINPUT_LOG     what a program that reads the event device would see, a report a line: "ABS_X=12 BTN_EAST=1"; the
//                  device with its axes when it is created and when it is destroyed; events that the kernel ignores
//                  without an error, as "dropped"; and "unread" if the device is destroyed before a game that reads 30
//                  times a second got the newest report
//   UINPUT_ERRNO   open() fails with this number
#include <dlfcn.h>
#include <fcntl.h>
#include <libevdev/libevdev.h>
#include <linux/uinput.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <array>
#include <bitset>
#include <cerrno>
#include <chrono>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

namespace {

enum class Setup { New, Complete, Created };  // 46

struct Device {
  Setup setup = Setup::New;
  std::string name;
  std::bitset<EV_CNT> types;
  std::bitset<KEY_CNT> keys, pressed;
  std::bitset<ABS_CNT> axes;
  std::array<input_absinfo, ABS_CNT> info{};  // of the axes
  std::vector<std::string> report;
  std::chrono::steady_clock::time_point reportTime{};  // of the newest
};

constexpr std::chrono::milliseconds ReadEvery(33);

int uinput = -1;
Device device;

template <typename Function>
Function *next(const char *name) {
  return reinterpret_cast<Function *>(dlsym(RTLD_NEXT, name));
}

void log(const std::string &line) {
  FILE *const file = std::fopen(std::getenv("UINPUT_LOG"), "a");
  std::fprintf(file, "%s\n", line.c_str());
  std::fclose(file);
}

std::string named(unsigned type, unsigned code, int value) {
  const char *const name = libevdev_event_code_get_name(type, code);
  return (name != nullptr ? name : std::to_string(type) + ":" + std::to_string(code)) + "=" + std::to_string(value);
}

// A range of 0 passes, 426; so does an axis without a range. input_absinfo.flat: 433.
int validate(const input_absinfo &axis) {
  const bool isBackwards = (axis.minimum != 0 || axis.maximum != 0) && axis.maximum < axis.minimum;
  return isBackwards || axis.flat > axis.maximum - axis.minimum ? EINVAL : 0;
}

template <size_t Count>
int set(std::bitset<Count> &bits, unsigned long code) {  // 839
  if (device.setup == Setup::Created || code >= Count) {
    return EINVAL;
  }
  bits.set(code);
  return 0;
}

int setAxis(const uinput_abs_setup &axis) {  // 509
  if (device.setup == Setup::Created) {
    return EINVAL;
  }
  if (axis.code > ABS_MAX) {
    return ERANGE;
  }
  const int error = validate(axis.absinfo);
  if (error == 0) {
    device.axes.set(axis.code);  // 538: UI_SET_ABSBIT is not needed
    device.info[axis.code] = axis.absinfo;
  }
  return error;
}

int setUp(const uinput_setup &setup) {  // 481
  if (device.setup == Setup::Created || setup.name[0] == '\0') {
    return EINVAL;
  }
  device.name = setup.name;
  device.setup = Setup::Complete;
  return 0;
}

int create() {  // 326
  if (device.setup != Setup::Complete) {
    return EINVAL;
  }
  device.setup = Setup::Created;
  std::string line = "created \"" + device.name + "\"";
  for (unsigned code = 0; code < ABS_CNT; code++) {
    const input_absinfo &info = device.info[code];
    if (device.axes.test(code)) {
      line += " " + named(EV_ABS, code, info.value) + " of " + std::to_string(info.minimum) + ".." +
              std::to_string(info.maximum) + (info.fuzz != 0 || info.flat != 0 ? " with a dead zone" : "");
    }
  }
  log(line + " buttons: " + std::to_string(device.keys.count()));
  return 0;
}

void destroy() {  // 296
  if (device.setup == Setup::Created) {
    // drivers/input/evdev.c, evdev_read(): nothing can be read from a device that is gone, not even waiting events;
    // joydev.c, joydev_read(), is the same.
    if (std::chrono::steady_clock::now() - device.reportTime < ReadEvery) {
      log("unread: the newest report");
    }
    log("destroyed");
  }
  device = {};
}

void flush() {  // input.c 372: SYN_REPORT alone is not a report
  std::string line;
  for (const std::string &event : device.report) {
    line += (line.empty() ? "" : " ") + event;
  }
  log(line.empty() ? "dropped: SYN_REPORT without an event" : line);
  device.reportTime = std::chrono::steady_clock::now();
  device.report.clear();
}

void take(
    const input_event &event) {  // input.c 237; codes that were never set: 428, 265, 291; unchanged values: 222, 273
  const std::string text = named(event.type, event.code, event.value);
  if (event.type == EV_SYN && event.code == SYN_REPORT) {
    return flush();
  }
  const bool isKey = event.type == EV_KEY && event.code < KEY_CNT && device.keys.test(event.code);
  const bool isAxis = event.type == EV_ABS && event.code < ABS_CNT && device.axes.test(event.code);
  if (event.type >= EV_CNT || !device.types.test(event.type) || (!isKey && !isAxis)) {
    return log("dropped: " + text + " was never set");
  }
  if (isKey ? device.pressed.test(event.code) == (event.value != 0) : device.info[event.code].value == event.value) {
    return log("dropped: " + text + " is as it was");
  }
  if (isKey) {
    device.pressed.set(event.code, event.value != 0);
  } else {
    device.info[event.code].value = event.value;
  }
  device.report.push_back(text);
  if (device.report.size() >= device.axes.count() + 8) {  // input.c 383, 2253: more than these do not fit into a report
    flush();
  }
}

int answer(unsigned long request, unsigned long value, void *pointer) {  // 875
  switch (request) {
    case UI_GET_VERSION:
      *static_cast<unsigned *>(pointer) = 5;
      return 0;
    case UI_SET_EVBIT:
      return set(device.types, value);
    case UI_SET_KEYBIT:
      return set(device.keys, value);
    case UI_SET_ABSBIT:
      return set(device.axes, value);
    case UI_ABS_SETUP:
      return setAxis(*static_cast<uinput_abs_setup *>(pointer));
    case UI_DEV_SETUP:
      return setUp(*static_cast<uinput_setup *>(pointer));
    case UI_DEV_CREATE:
      return create();
    case UI_DEV_DESTROY:
      destroy();
      return 0;
    default:
      break;
  }
  if (_IOC_TYPE(request) == UINPUT_IOCTL_BASE && _IOC_NR(request) == _IOC_NR(UI_GET_SYSNAME(0))) {  // 1055
    if (device.setup != Setup::Created) {
      return ENOENT;
    }
    std::snprintf(static_cast<char *>(pointer), _IOC_SIZE(request), "input4294967295");
    return 0;
  }
  return EINVAL;  // 1069
}

int result(int error) {
  errno = error;
  return error == 0 ? 0 : -1;
}

}  // namespace

extern "C" {

int open(const char *path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(arguments, mode_t) : 0;
  va_end(arguments);
  const auto real = next<int(const char *, int, ...)>("open");
  if (std::strcmp(path, "/dev/uinput") != 0) {
    return real(path, flags, mode);
  }
  const char *const error = std::getenv("UINPUT_ERRNO");
  return error != nullptr ? result(std::atoi(error)) : uinput = real("/dev/null", O_RDWR | O_CLOEXEC);
}

int ioctl(int file, unsigned long request, ...) noexcept {
  va_list arguments;
  va_start(arguments, request);
  void *const pointer = va_arg(arguments, void *);
  va_end(arguments);
  return file < 0 || file != uinput ? next<int(int, unsigned long, ...)>("ioctl")(file, request, pointer)
                                    : result(answer(request, reinterpret_cast<unsigned long>(pointer), pointer));
}

ssize_t write(int file, const void *bytes, size_t size) {
  if (file < 0 || file != uinput) {
    return next<ssize_t(int, const void *, size_t)>("write")(file, bytes, size);
  }
  if (size == 0) {
    return 0;
  }
  if (device.setup != Setup::Created || size < sizeof(input_event)) {  // 552, 613
    return result(EINVAL);
  }
  const size_t count = size / sizeof(input_event);  // a part of an event is ignored: 616
  for (size_t i = 0; i < count; i++) {
    input_event event;
    std::memcpy(&event, static_cast<const char *>(bytes) + i * sizeof event, sizeof event);
    take(event);
  }
  return static_cast<ssize_t>(count * sizeof(input_event));
}

int close(int file) {
  if (file >= 0 && file == uinput) {
    uinput = -1;
    destroy();  // 741
  }
  return next<int(int)>("close")(file);
}

}  // extern "C"
