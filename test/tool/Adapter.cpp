// A receiver at a USB adapter, in real time: a pseudo-terminal that delivers bytes like support/Adapter.h.
//
//   Adapter LINE PERIOD_MS LATENCY_MS FRAMES      LINE: 16, 24, sbus2 (two telemetry slots after each frame), 2F
//
// It prints the terminal's name, and sends the frames when a program has opened it.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

#include "impairment/ImpairedLine.h"
#include "line/ports/PseudoTerminal.h"
#include "support/Adapter.h"

namespace {

using Clock = std::chrono::steady_clock;

Transmission transmission(const std::string &line, const char *periodMs, const char *frames) {
  Transmission sent;
  sent.sticks = Payload::Neutral;
  sent.periodUs = static_cast<uint32_t>(std::strtod(periodMs, nullptr) * 1000);
  sent.frames = std::strtoul(frames, nullptr, 10);
  sent.kind = line == "24"      ? Kind::Channels24
              : line == "sbus2" ? Kind::Sbus2
              : line == "2F"    ? Kind::With2F
                                : Kind::Plain;
  sent.company.slots = sent.kind == Kind::Sbus2 ? 2 : 0;
  sent.company.afterEach = true;
  return sent;
}

}  // namespace

int main(int count, char **arguments) {
  if (count != 5) {
    return EXIT_FAILURE;
  }
  line::PseudoTerminal terminal;
  std::printf("%s\n", terminal.name().c_str());
  std::fflush(stdout);
  while (!terminal.hasReader()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  std::this_thread::sleep_for(
      std::chrono::milliseconds(200));  // the program drops bytes that arrive before it has set up the port
  const auto start = Clock::now();
  Random random(20181);
  ImpairedLine line(transmission(arguments[1], arguments[2], arguments[4]), 5000, random);
  Adapter adapter(static_cast<uint32_t>(std::strtoul(arguments[3], nullptr, 10) * 1000), random);
  const auto hand = [&](const Read &read) {
    std::vector<uint8_t> bytes;
    for (const line::Character &character : read.characters) {
      bytes.push_back(character.value);
    }
    std::this_thread::sleep_until(start + std::chrono::microseconds(read.us));
    terminal.write(bytes.data(), bytes.size());
  };
  uint64_t us = 0;
  for (line::Character character; line.nextUs() != UINT64_MAX; adapter.put(character, hand)) {
    us = line.nextUs();
    line.next(us, character);
  }
  adapter.runTo(us + 50000, hand);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
}
