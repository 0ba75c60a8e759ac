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
#include <vector>

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

bool useTerminalLocale() {
  return setlocale(LC_CTYPE, ".UTF-8") != nullptr;
}

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

bool syncFile(int file) {
  return _commit(file) == 0 || errno == EBADF;
}

void syncFolder(const std::string & /*name*/) {
}

bool isPortName(const std::string &name) {
  const std::string device = name.rfind("\\\\.\\", 0) == 0 ? name.substr(4) : name;
  return device.size() > 3 && _strnicmp(device.c_str(), "COM", 3) == 0 &&
         device.find_first_not_of("0123456789", 3) == std::string::npos;
}

bool mayOpen(const std::string & /*port*/) {
  return true;
}

}  // namespace line

#endif
