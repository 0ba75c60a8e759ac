// Everything that differs between Linux, macOS and Windows: here, in Posix.cpp and Windows.cpp, and for ports in
// PosixPort.cpp.
#pragma once

#include <fcntl.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>

namespace line {

#if defined(_WIN32)
constexpr const char *PortsPlace = "the Device Manager, below Ports (COM & LPT)";  // where users find their names
constexpr const char *Keyboard = "CONIN$";
constexpr bool HasTerminfo = false;
constexpr int LineBuffering = _IONBF;  // for std::setvbuf(): _IOLBF does not flush lines
constexpr int CloseOnExec = _O_NOINHERIT;
#else
#if defined(__APPLE__)
constexpr const char *PortsPlace = "/dev, such as /dev/cu.usbserial-A50285BI";
#else
constexpr const char *PortsPlace = "/dev/serial/by-id";
#endif
constexpr const char *Keyboard = "/dev/tty";
constexpr bool HasTerminfo = true;
constexpr int LineBuffering = _IOLBF;
constexpr int CloseOnExec = O_CLOEXEC;
#endif

// Prepares the standard streams. Call it once, before anything is opened. No file can take a closed stream's number;
// bytes pass through unchanged; writing to a closed pipe is an error of write().
void prepareStreams();

// Returns true if a write failed with `error` because the reader of a pipe is gone.
inline bool isReaderGone(int error) {
  return error == EPIPE || error == EINVAL;  // Windows: EINVAL
}

// Returns the width of the terminal in columns; 0 if standard output is not a terminal.
size_t terminalColumns();

// Selects the terminal's locale. Returns true if it uses UTF-8.
bool useTerminalLocale();

// Calls `handler` on Ctrl-C, and when the terminal or the system ends the program. SIG_DFL: it ends at once.
void onStop(void (*handler)(int signal));

// Waits up to `ms`; if negative, without limit. Returns true if read() would not wait; a signal (on Windows: 50 ms)
// ends the wait early with false.
bool isReadable(int file, int ms);

// Returns microseconds of a clock that all programs of this PC share, never goes back, and goes on while the PC sleeps:
// the age of a frame in a pipe is a difference of two of them. The date would jump when it is set.
uint64_t clockUs();

// Opens a file without a name, which vanishes when it is closed. On failure returns -1 and sets errno.
int openTemporary();

// Waits until the disk itself has what was written to the file. Returns false and sets errno on failure; a pipe or a
// file that only exists in memory is no failure.
bool syncFile(int file);

// Does the same for the entries of a folder; "" is the current one. Windows writes them by itself.
void syncFolder(const std::string &name);

// Returns true for the name of a port, whether or not it exists.
bool isPortName(const std::string &name);

// Returns true if the user may open the port.
bool mayOpen(const std::string &port);

}  // namespace line
