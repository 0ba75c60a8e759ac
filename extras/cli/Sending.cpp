#include "cli/Sending.h"

#include <chrono>
#include <cstdio>
#include <thread>
#include <utility>
#include <vector>

#include "cli/Output.h"
#include "cli/Stop.h"
#include "line/ports/PseudoTerminal.h"
#include "line/ports/SendingPort.h"

namespace tool {

namespace {

void say(const std::string &text) {
  std::fprintf(stderr, "%s\n", text.c_str());
}

// The port or pseudo-terminal that the bytes go to.
class Destination {
 public:
  Destination(const std::string &to, const line::LineSettings &settings) {
    if (to.empty()) {
      _terminal = std::make_unique<line::PseudoTerminal>();
      write(_terminal->name() + "\n");
      flush();
    } else {
      _port = std::make_unique<line::SendingPort>(to, settings);
    }
  }

  // Waits until a program has opened the pseudo-terminal. Returns false if the end was asked for.
  bool waitForReader() const {
    if (!_terminal) {
      return true;
    }
    if (!_terminal->hasReader()) {
      say("waiting until a program opens " + _terminal->name() + "; Ctrl-C ends it");
    }
    while (!_terminal->hasReader() && !stopped()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    // A program sets the port that it has opened, and throws away what has come until then.
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    return !stopped();
  }

  // Gives a busy reader time to read the end: Linux throws away what waits in a pseudo-terminal that is closed.
  void finish() const {
    if (_terminal && _terminal->hasReader()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
    }
  }

  // Returns how many bytes were sent.
  size_t send(uint64_t nowUs, const std::vector<uint8_t> &bytes) {
    if (_terminal) {
      return _terminal->write(bytes.data(), bytes.size());
    }
    const size_t sent = _port->write(nowUs, bytes.data(), bytes.size());
    const std::string news = _port->news();
    if (!news.empty()) {
      say(news);
    }
    return sent;
  }

 private:
  std::unique_ptr<line::PseudoTerminal> _terminal;
  std::unique_ptr<line::SendingPort> _port;
};

// Collects characters that are back to back, to send them in one piece: sent singly they would get silences between
// them.
class Bursts {
 public:
  explicit Bursts(uint32_t characterUs) : _characterUs(characterUs) {}

  void put(const line::Character &character) {
    _lastEndUs = character.endUs;
    if (!character.bad) {
      _bytes.push_back(character.value);
    }
  }

  // Returns the burst once it is complete; otherwise nothing.
  std::vector<uint8_t> take(uint64_t nowUs) {
    const bool ready = nowUs >= _lastEndUs + 2 * _characterUs || _bytes.size() >= BurstMax;
    return ready ? std::exchange(_bytes, {}) : std::vector<uint8_t>();
  }

 private:
  static constexpr size_t BurstMax = 64;

  uint32_t _characterUs;
  std::vector<uint8_t> _bytes;
  uint64_t _lastEndUs = 0;
};

}  // namespace

Sending::Sending(Subcommand &subcommand) {
  subcommand.option("--port", _to, "a serial port; without it a pseudo-terminal, whose name is printed").type("DEVICE");
}

void Sending::run(Input &input) const {
  input.check();
  Destination destination(_to, input.settings());
  if (!destination.waitForReader()) {
    return;
  }
  say("sending; Ctrl-C ends it");
  unsigned long sent = 0;
  unsigned long lost = 0;
  unsigned long bad = 0;
  Bursts bursts(input.settings().characterUs());
  input.run(
      [&](const line::Character &character) {
        bad += character.bad;
        bursts.put(character);
      },
      [&](uint64_t nowUs) {
        const std::vector<uint8_t> bytes = bursts.take(nowUs);
        if (!bytes.empty()) {
          const size_t count = destination.send(nowUs, bytes);
          sent += count;
          lost += bytes.size() - count;
        }
      });
  destination.finish();
  say(std::to_string(sent) + " characters sent" +
      (lost > 0 ? "; " + std::to_string(lost) + " lost: the reader was too slow, or gone" : "") +
      (bad > 0 ? "; " + std::to_string(bad) + " with errors left out: no port can send them" : ""));
}

}  // namespace tool
