// Ports that may disappear and come back: an adapter that is unplugged and plugged in again. A pseudo-terminal never
// comes back: the next one with its name may belong to another program.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "line/ports/PortFile.h"
#include "line/ports/SerialPort.h"

namespace line {

template <typename Port>
class Reopened {
 public:
  using Open = std::function<std::unique_ptr<Port>()>;

  // Opens the port. Throws std::runtime_error from `open`.
  Reopened(std::string device, Open open) : _device(std::move(device)), _open(std::move(open)), _port(_open()) {}

  // Returns the port; nullptr while it is gone. Retries from time to time.
  Port *at(uint64_t nowUs) {
    if (!_port && nowUs >= _retryUs && canComeBack()) {
      _retryUs = nowUs + RetryUs;
      reopen();
    }
    return _port.get();
  }

  // Notes that the port is gone.
  void gone() {
    _port.reset();  // while it is open, the system would give the adapter another name
    _news = _device + (canComeBack() ? ": the port is gone; plug the adapter in again to go on"
                                     : ": the program at the other end is gone");
  }

  // Returns true if it is gone and will not come back.
  bool finished() const { return !_port && !canComeBack(); }

  // See Line::news().
  std::string news() { return std::exchange(_news, {}); }

 private:
  static constexpr uint64_t RetryUs = 500000;

  bool canComeBack() const { return !isPseudoTerminal(_device); }

  void reopen() {
    try {
      _port = _open();
      _news = _device + ": the port is back";
    } catch (const std::runtime_error &) {
      // Try again: a port that has just come back may still belong to root.
    }
  }

  std::string _device;
  Open _open;
  std::unique_ptr<Port> _port;
  uint64_t _retryUs = 0;  // the time of the next attempt
  std::string _news;
};

// A port to read from.
class ReopenedPort : public Line {
 public:
  // Opens the port. Throws std::runtime_error.
  ReopenedPort(const std::string &device, const LineSettings &settings)
      : _port(device, [=] { return std::make_unique<SerialPort>(device, settings); }) {}

  bool next(uint64_t nowUs, Character &character) override {
    _open = _port.at(nowUs);
    const bool came = _open != nullptr && _open->next(nowUs, character);
    if (_open != nullptr && !came && !_open->failure().empty()) {
      _port.gone();
      _open = nullptr;
    }
    return came;
  }
  uint64_t knownUs(uint64_t nowUs) const override { return _open == nullptr ? 0 : _open->knownUs(nowUs); }
  bool wait() override {
    if (_open != nullptr) {
      return _open->wait();
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return true;
  }
  bool finished(uint64_t) const override { return _port.finished(); }
  bool isBroken() const override { return true; }
  std::string note() const override { return _open == nullptr ? "" : _open->note(); }
  std::string news() override { return _port.news(); }

 private:
  Reopened<SerialPort> _port;
  SerialPort *_open = nullptr;  // null while it is gone
};

// A port to write to.
class SendingPort : public Reopened<PortFile> {
 public:
  // Opens the port. Throws std::runtime_error.
  SendingPort(const std::string &device, const LineSettings &settings)
      : Reopened(device, [=] { return std::make_unique<PortFile>(device, settings, PortFile::Way::Write); }) {}

  // Writes without waiting; bytes are lost if the port is full or gone. Returns the number written.
  size_t write(uint64_t nowUs, const uint8_t *bytes, size_t size) {
    PortFile *const port = at(nowUs);
    const std::ptrdiff_t count = port == nullptr ? 0 : port->write(bytes, size);
    if (count < 0) {
      gone();
    }
    return count > 0 ? static_cast<size_t>(count) : 0;
  }
};

}  // namespace line
