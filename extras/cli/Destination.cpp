#include "cli/Destination.h"

#include <chrono>
#include <cstdio>
#include <stdexcept>
#include <thread>

#include "cli/Output.h"
#include "cli/Stop.h"
#include "line/Format.h"

namespace tool {

Destination::Destination(const std::string &to, const line::LineSettings &settings) {
  if (to.empty()) {
    _terminal = std::make_unique<line::PseudoTerminal>();
    write(_terminal->name() + "\n");
    flush();
  } else {
    line::LineSettings wanted = settings;  // of a line with one stop bit: what reads S.Bus may need two
    wanted.format.stopBits = settings.format.parity == line::Parity::Even ? 2 : settings.format.stopBits;
    _port = std::make_unique<line::SendingPort>(to, wanted);
  }
}

bool Destination::waitForReader(double seconds) const {
  if (!_terminal) {
    return true;
  }
  if (!_terminal->hasReader()) {
    std::fprintf(stderr, "waiting for a program to open %s; Ctrl-C ends it\n", _terminal->name().c_str());
  }
  const auto begin = std::chrono::steady_clock::now();
  while (!_terminal->hasReader() && !stopped()) {
    if (seconds > 0 && std::chrono::steady_clock::now() - begin > std::chrono::duration<double>(seconds)) {
      throw std::runtime_error("no program has opened " + _terminal->name() + line::format(" within %g s", seconds) +
                               "; start the reader earlier, or leave --seconds out");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  // A program that opens a port sets it up first, and discards the bytes received before that.
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  return !stopped();
}

void Destination::finish() const {
  if (_terminal && _terminal->hasReader()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
  }
}

bool Destination::holdsBytes(uint64_t nowUs) {
  line::PortFile *const port = _port ? _port->at(nowUs) : nullptr;
  return _terminal ? _terminal->holdsBytes() : port != nullptr && port->holdsBytes();
}

bool Destination::mayMissReads(uint64_t nowUs) {
  line::PortFile *const port = _port ? _port->at(nowUs) : nullptr;
  return _terminal || (port != nullptr && port->mayMissReads());
}

void Destination::discard(uint64_t nowUs) {
  line::PortFile *const port = _port ? _port->at(nowUs) : nullptr;
  if (port != nullptr) {
    port->discard();
  }
}

size_t Destination::send(uint64_t nowUs, const std::vector<uint8_t> &bytes) {
  if (_terminal) {
    return _terminal->write(bytes.data(), bytes.size());
  }
  const size_t sent = _port->write(nowUs, bytes.data(), bytes.size());
  const std::string news = _port->news();
  if (!news.empty()) {
    std::fprintf(stderr, "%s\n", news.c_str());
  }
  return sent;
}

}  // namespace tool
