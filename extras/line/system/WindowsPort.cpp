#if defined(_WIN32)

#include <windows.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "line/ports/PortFile.h"
#include "line/ports/PseudoTerminal.h"
#include "line/system/System.h"

namespace line {

namespace {

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
void PortFile::openPseudoTerminal(const std::string & /*device*/, Way /*way*/) {
}

int PortFile::file() const {
  return -1;
}

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

bool PseudoTerminal::hasReader() const {
  return false;
}

size_t PseudoTerminal::write(const uint8_t * /*bytes*/, size_t /*size*/) {
  return 0;
}

size_t PseudoTerminal::read(uint8_t * /*bytes*/, size_t /*size*/) {
  return 0;
}

}  // namespace line

#endif
