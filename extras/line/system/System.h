// What differs between Linux, macOS and Windows: here, in Posix.cpp and Windows.cpp, and of ports in PosixPort.cpp and
// WindowsPort.cpp.
#pragma once

#include <fcntl.h>

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <string>

namespace line {

#if defined(_WIN32)
constexpr const char *PortsPlace = "the Device Manager, below Ports (COM & LPT)";  // where a user finds their names
constexpr const char *Keyboard = "CONIN$";
constexpr bool HasTerminfo = false;
constexpr int LineBuffering = _IONBF;  // of std::setvbuf(); _IOLBF does not hand lines over
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

// Prepares standard input and output, once, before anything is opened. A file never takes the number of a closed one;
// bytes pass through unchanged; a closed pipe becomes an error of write().
void prepareStreams();

// Returns true if a write failed with `error` because the reader of a pipe has gone.
inline bool isReaderGone(int error) {
  return error == EPIPE || error == EINVAL;  // Windows: EINVAL
}

// Returns the width of the terminal in columns; 0 if standard output is no terminal.
size_t terminalColumns();

// Takes the locale of the terminal. Returns true if it has UTF-8.
bool useTerminalLocale();

// Calls `handler` at Ctrl-C, and when the terminal or the system ends the program. SIG_DFL: it ends at once.
void onStop(void (*handler)(int signal));

// Waits up to `ms`, if negative without end. Returns true if read() would not wait; false also before, at a signal (on
// Windows: every 50 ms).
bool isReadable(int file, int ms);

// Opens a file without a name, which vanishes when it is closed. Returns -1 and sets errno if that is not possible.
int openTemporary();

// Returns true if the name is a port's, whether or not the port is there.
bool isPortName(const std::string &name);

// Returns true if the user may open the port.
bool mayOpen(const std::string &port);

}  // namespace line
