#include "cli/Sending.h"

#include <cstdio>
#include <stdexcept>
#include <utility>
#include <vector>

#include "cli/Destination.h"

namespace tool {

namespace {

void say(const std::string &text) {
  std::fprintf(stderr, "%s\n", text.c_str());
}

// Collects back-to-back characters to send them in one piece: sent singly they would be separated by silences.
class Bursts {
 public:
  explicit Bursts(uint32_t characterUs) : _characterUs(characterUs) {}

  void put(const line::Character &character) {
    _lastEndUs = character.endUs;
    if (!character.bad) {
      _bytes.push_back(character.value);
    }
  }

  // Returns the burst if it is complete; otherwise nothing.
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
  subcommand.option("--port", _to, "a serial port; without it, a pseudo-terminal (prints its name)").type("DEVICE");
}

void Sending::run(Input &input) const {
  input.check();
  Destination destination(_to, input.settings());
  if (!destination.waitForReader(input.seconds())) {
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
          if (destination.isGone()) {
            input.end();
          }
        }
      });
  destination.finish();
  say(std::to_string(sent) + " characters sent" +
      (lost > 0 ? "; " + std::to_string(lost) + " lost: the reader was too slow or gone" : "") +
      (bad > 0 ? "; " + std::to_string(bad) + " with errors left out: no port can send them" : ""));
  if (destination.isGone()) {
    throw std::runtime_error(_to + ": no program reads it any longer; start the reader, then this again");
  }
}

}  // namespace tool
