// To be preloaded: the PC sleeps, and files fail as a worn-out disk or card does.
//
//   ASLEEP=N,S                 the PC sleeps for S seconds after N ms, which CLOCK_MONOTONIC does not count
//   EIO=read,NAME,BYTES        read() of a file of which the name contains NAME fails once BYTES have been read;
//   EIO=write,NAME,BYTES       likewise write(); EIO=fsync,NAME,0: fsync()
#include <dlfcn.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

template <typename Function>
Function real(const char *name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

size_t done = 0;

// Returns true if this call, of the kind `call`, has to fail.
bool fails(const char *call, int file) {
  const char *const wanted = std::getenv("EIO");
  if (wanted == nullptr || std::strncmp(wanted, call, std::strlen(call)) != 0) {
    return false;
  }
  const std::string rest = std::strchr(wanted, ',') + 1;
  char name[1024];
  const ssize_t size = readlink(("/proc/self/fd/" + std::to_string(file)).c_str(), name, sizeof name);
  const std::string path(name, size > 0 ? static_cast<size_t>(size) : 0);
  const bool is = path.find(rest.substr(0, rest.find(','))) != std::string::npos &&
                  done >= std::strtoul(&rest[rest.find(',') + 1], nullptr, 10);
  errno = is ? EIO : errno;
  return is;
}

ssize_t counted(ssize_t count, const char *call) {
  const char *const wanted = std::getenv("EIO");
  done += wanted != nullptr && std::strncmp(wanted, call, std::strlen(call)) == 0 && count > 0
              ? static_cast<size_t>(count)
              : 0;
  return count;
}

}  // namespace

extern "C" {

int clock_gettime(clockid_t clock, timespec *time) {
  static const auto next = real<int (*)(clockid_t, timespec *)>("clock_gettime");
  const int status = next(clock, time);
  const char *const asleep = std::getenv("ASLEEP");
  if (clock == CLOCK_BOOTTIME && asleep != nullptr) {
    static const timespec first = *time;
    const long ms = (time->tv_sec - first.tv_sec) * 1000 + (time->tv_nsec - first.tv_nsec) / 1000000;
    time->tv_sec += ms < std::atol(asleep) ? 0 : std::atol(std::strchr(asleep, ',') + 1);
  }
  return status;
}

ssize_t read(int file, void *bytes, size_t size) {
  static const auto next = real<ssize_t (*)(int, void *, size_t)>("read");
  return fails("read", file) ? -1 : counted(next(file, bytes, size), "read");
}

ssize_t write(int file, const void *bytes, size_t size) {
  static const auto next = real<ssize_t (*)(int, const void *, size_t)>("write");
  return fails("write", file) ? -1 : counted(next(file, bytes, size), "write");
}

ssize_t writev(int file, const iovec *pieces, int count) {
  static const auto next = real<ssize_t (*)(int, const iovec *, int)>("writev");
  return fails("write", file) ? -1 : counted(next(file, pieces, count), "write");
}

int fsync(int file) {
  static const auto next = real<int (*)(int)>("fsync");
  return fails("fsync", file) ? -1 : next(file);
}
}
