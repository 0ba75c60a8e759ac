// Prints what the library costs on a Cortex-M0+, in instructions.
//   Bench         Markdown
//   Bench check   "ok bench: ..." and "FAILED bench: ...": the bounds
#include "Bench.h"

#include <cstdio>
#include <cstring>

#include "Cost.h"

namespace {

bool failed = false;

void print() {
  std::printf(
      "arm-none-eabi-g++ %s. Every instruction counts, those of the call and of micros() with it; the port's own\n"
      "are subtracted, and its calls are counted instead: on a board they cost more than in memory.\n\n",
      __VERSION__);
  printFrames();
  printLongestCall();
}

void check() {
  checkFrames();
  checkLongestCall();
}

}  // namespace

void verdict(bool good, const std::string &what) {
  std::printf("%s bench: %s\n", good ? "ok" : "FAILED", what.c_str());
  failed = failed || !good;
}

void atMost(const std::string &what, uint32_t found, uint32_t most) {
  // A frame that costs 400 with GCC 12.2 costs 421 with 13.3, and 416 with 14.2.
  const uint32_t allowed = __GNUC__ == 12 ? most : most + most / 4;
  verdict(found > 0 && found <= allowed,
          what + ": " + std::to_string(found) + " instructions, at most " + std::to_string(allowed));
}

int main(int argc, char **argv) {
  const bool isCheck = argc > 1 && std::strcmp(argv[1], "check") == 0;
  if (!calibrate()) {
    verdict(false, "instructions cannot be counted here");
  } else {
    (isCheck ? check : print)();
  }
  return failed ? 1 : 0;
}
