// A real port that brings no frames: which messages come, and when.
#include "board/PortWatch.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "line/simulation/SimulatedReceiver.h"

using namespace host;

namespace {

constexpr uint64_t Second = 1000000;

// Returns the messages of ten seconds. Characters come from `fromUs` to `toUs`; `noise`: they make no frame.
std::vector<std::string> said(const std::string &device, uint64_t fromUs, uint64_t toUs, bool noise = false) {
  line::SimulatedReceiver receiver;
  receiver.opened(0);
  line::Observer observer;
  PortWatch watch(device, observer);
  std::vector<std::string> lines;
  for (uint64_t nowUs = 0; nowUs < 10 * Second; nowUs += 500) {
    for (line::Character character; receiver.next(nowUs, character);) {
      if (nowUs >= fromUs && nowUs < toUs) {
        character.value = noise ? uint8_t{0x55} : character.value;
        observer.put(character);
      }
    }
    observer.idleUntil(nowUs);
    const std::string line = watch.check(nowUs);
    if (!line.empty()) {
      lines.push_back(line.substr(0, line.find('.')));
    }
  }
  return lines;
}

using Lines = std::vector<std::string>;

}  // namespace

TEST_CASE("a silent port is reported at once, and every three seconds") {
  CHECK(said("tty", 0, 0) == Lines{"waiting for frames from tty", "3 s: no bytes from tty",
                                   "6 s: no bytes from tty", "9 s: no bytes from tty"});
}

TEST_CASE("characters that make no frame are reported") {
  CHECK(said("tty", 0, 7 * Second, true) ==
        Lines{"waiting for frames from tty", "3 s: no frames in the bytes from tty",
              "6 s: no frames in the bytes from tty", "9 s: no frames in the bytes from tty"});
}

TEST_CASE("while frames come nothing is reported, until they end") {
  CHECK(said("tty", 0, 10 * Second) == Lines{"waiting for frames from tty"});
  CHECK(said("tty", 0, 5 * Second) == Lines{"waiting for frames from tty", "9 s: no bytes from tty"});
}

TEST_CASE("without a real port nothing is reported") {
  CHECK(said("", 0, 0).empty());
}
