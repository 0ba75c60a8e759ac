#if defined(_WIN32)

#include <io.h>
#include <locale.h>
#include <sys/stat.h>
#include <unistd.h>
#include <windows.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <thread>
#include <vector>

#include "line/ports/PortFile.h"
#include "line/ports/PseudoTerminal.h"
#include "line/system/System.h"

namespace line {

namespace {

constexpr DWORD WaitMost = 50;  // ms: Ctrl-C does not interrupt a wait

// A console also has mouse, window and key-up events, but read() waits for Enter.
bool hasEnter(HANDLE console) {
  DWORD count = 0;
  if (GetNumberOfConsoleInputEvents(console, &count) == 0) {
    return true;  // NUL
  }
  std::vector<INPUT_RECORD> events(count + 1);
  PeekConsoleInputW(console, events.data(), count + 1, &count);
  return std::any_of(events.begin(), events.begin() + count, [](const INPUT_RECORD &event) {
    return event.EventType == KEY_EVENT && event.Event.KeyEvent.bKeyDown != 0 &&
           event.Event.KeyEvent.wVirtualKeyCode == VK_RETURN;
  });
}

bool isReadableNow(int file) {
  const HANDLE handle = reinterpret_cast<HANDLE>(_get_osfhandle(file));
  DWORD waiting = 0;
  switch (GetFileType(handle)) {
    case FILE_TYPE_CHAR:
      return hasEnter(handle);
    case FILE_TYPE_PIPE:
      return PeekNamedPipe(handle, nullptr, 0, nullptr, &waiting, nullptr) == 0 || waiting > 0;  // at its end it fails
    default:
      return true;
  }
}

HANDLE handleOf(sp_port *port) {
  HANDLE handle = INVALID_HANDLE_VALUE;
  sp_get_port_handle(port, &handle);
  return handle;
}

// Like sp_nonblocking_read(), which loses errors that occur meanwhile.
DWORD readNow(HANDLE handle, uint8_t *bytes, size_t size) {
  OVERLAPPED operation{};
  operation.hEvent = CreateEventA(nullptr, TRUE, FALSE, nullptr);
  DWORD count = 0;
  if (ReadFile(handle, bytes, static_cast<DWORD>(size), nullptr, &operation) != 0 ||
      GetLastError() == ERROR_IO_PENDING) {
    GetOverlappedResult(handle, &operation, &count, TRUE);
  }
  CloseHandle(operation.hEvent);
  return count;
}
}  // namespace

void prepareStreams() {
  for (const int stream : {0, 1}) {
    _setmode(stream, _O_BINARY);
  }
  _fmode = _O_BINARY;  // for all files, including std::ifstream
  timeBeginPeriod(1);  // ms; otherwise a wait of 1 ms would last 16
  const HANDLE console = GetStdHandle(STD_OUTPUT_HANDLE);
  DWORD mode = 0;
  if (GetConsoleMode(console, &mode) != 0) {
    SetConsoleMode(console, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING);  // colours
    SetConsoleOutputCP(CP_UTF8);
  }
}

size_t terminalColumns() {
  CONSOLE_SCREEN_BUFFER_INFO info{};
  const bool known = GetConsoleScreenBufferInfo(GetStdHandle(STD_OUTPUT_HANDLE), &info) != 0;
  return known ? static_cast<size_t>(info.srWindow.Right - info.srWindow.Left + 1) : 0;
}

bool useTerminalLocale() { return setlocale(LC_CTYPE, ".UTF-8") != nullptr; }

void onStop(void (*handler)(int signal)) {
  static void (*stop)(int) = SIG_DFL;
  stop = handler;
  std::signal(SIGINT, handler);
  std::signal(SIGTERM, handler);
  if (handler == SIG_DFL) {
    std::signal(SIGBREAK, SIG_DFL);
    return;
  }
  std::signal(SIGBREAK, [](int signal) {
    stop(signal);
    Sleep(INFINITE);  // the window was closed: Windows ends the program when this returns, before main() does
  });
}

bool isReadable(int file, int ms) {
  const ULONGLONG endMs = GetTickCount64() + std::min(WaitMost, static_cast<DWORD>(ms));
  while (!isReadableNow(file)) {
    if (GetTickCount64() >= endMs) {
      return false;
    }
    Sleep(1);
  }
  return true;
}

uint64_t clockUs() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();  // QueryPerformanceCounter()
  return static_cast<uint64_t>(std::chrono::duration_cast<std::chrono::microseconds>(now).count());
}

// std::tmpfile() would use the drive's root, where few users may write.
int openTemporary() {
  char name[MAX_PATH];
  if (GetTempFileNameA(std::filesystem::temp_directory_path().string().c_str(), "sbs", 0, name) == 0) {
    errno = EACCES;
    return -1;
  }
  return open(name, _O_RDWR | _O_TEMPORARY | CloseOnExec);
}

bool syncFile(int file) { return _commit(file) == 0 || errno == EBADF; }

void syncFolder(const std::string & /*name*/) {}

bool isPortName(const std::string &name) {
  const std::string device = name.rfind("\\\\.\\", 0) == 0 ? name.substr(4) : name;
  return device.size() > 3 && _strnicmp(device.c_str(), "COM", 3) == 0 &&
         device.find_first_not_of("0123456789", 3) == std::string::npos;
}

bool mayOpen(const std::string & /*port*/) { return true; }

std::string openError(const std::string &device, int error, const std::string &message) {
  switch (error) {
    case 0:  // libserialport does not know the name
    case ERROR_FILE_NOT_FOUND:
      return device + ": there is no such port; plug the adapter in and look for its name in " + PortsPlace;
    case ERROR_ACCESS_DENIED:
      return device + ": in use; close the other program that has it open";
    default:
      return device + ": not a serial port that can be opened (" + message + "); name the adapter's port";
  }
}

// Never called: no port has such a name.
void PortFile::openPseudoTerminal(const std::string & /*device*/, Way /*way*/) {}

int PortFile::file() const { return -1; }

bool PortFile::markErrors() {
  DCB settings{};
  settings.DCBlength = sizeof settings;
  const HANDLE handle = handleOf(_port.get());
  if (GetCommState(handle, &settings) == 0) {
    return false;
  }
  settings.fParity = TRUE;
  COMMTIMEOUTS atOnce{};
  atOnce.ReadIntervalTimeout = MAXDWORD;
  const bool done = SetCommState(handle, &settings) != 0 && SetCommTimeouts(handle, &atOnce) != 0;
  sp_flush(_port.get(), SP_BUF_INPUT);
  return done;
}

// Returns the number of waiting characters, and notes whether any had errors; -1 if the port is gone.
std::ptrdiff_t PortFile::waiting() {
  DWORD errors = 0;
  COMSTAT state{};
  if (ClearCommError(handleOf(_port.get()), &errors, &state) == 0) {
    return -1;
  }
  _errors = _errors || (errors & (CE_RXPARITY | CE_FRAME | CE_BREAK)) != 0;
  return static_cast<std::ptrdiff_t>(state.cbInQue);
}

// The system reports errors, but not where, so all characters may be wrong.
std::ptrdiff_t PortFile::read(uint8_t *bytes, size_t size) {
  const std::ptrdiff_t came = waiting();
  if (came <= 0) {
    return came;
  }
  uint8_t raw[256];
  const size_t wanted = std::min({size / 3, sizeof raw, static_cast<size_t>(came)});  // a mark takes two bytes
  const DWORD count = readNow(handleOf(_port.get()), raw, wanted);
  uint8_t *end = bytes;
  for (DWORD i = 0; i < count; i++) {
    if (_errors) {
      *end++ = 0xFF;
      *end++ = 0x00;
    } else if (raw[i] == 0xFF) {
      *end++ = 0xFF;
    }
    *end++ = raw[i];
  }
  _errors = _errors && static_cast<std::ptrdiff_t>(count) < came;  // the rest may have them
  return end - bytes;
}

std::ptrdiff_t PortFile::write(const uint8_t *bytes, size_t size) {
  const int count = sp_nonblocking_write(_port.get(), bytes, size);
  return count >= 0 ? count : -1;
}

void PortFile::wait(int ms) {
  for (int waited = 0; waited < ms && waiting() == 0; waited++) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

PseudoTerminal::PseudoTerminal() {
  throw std::runtime_error("Windows has no pseudo-terminals; name a serial port: --port COM3");
}

PseudoTerminal::~PseudoTerminal() = default;

bool PseudoTerminal::hasReader() const { return false; }

size_t PseudoTerminal::write(const uint8_t * /*bytes*/, size_t /*size*/) { return 0; }

size_t PseudoTerminal::read(uint8_t * /*bytes*/, size_t /*size*/) { return 0; }

}  // namespace line

#endif
