// Settings from the environment: FRAMES=1000000 SEED=7
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>

// Returns a number of `least` or more. Another text ends the program with status 2.
inline uint64_t setting(const char *name, uint64_t otherwise, uint64_t least = 0) {
  const char *const text = std::getenv(name);
  if (text == nullptr || *text == 0) {
    return otherwise;
  }
  char *end = nullptr;
  const uint64_t value = std::strtoull(text, &end, 10);
  if (*text < '0' || *text > '9' || *end != 0 || value < least || value == UINT64_MAX) {
    std::fprintf(stderr, "%s=%s: a number is expected, %u or more\n", name, text, static_cast<unsigned>(least));
    std::exit(2);
  }
  return value;
}

// Returns SEED, by default the number of the day since 1970 (UTC).
inline uint64_t seedOfDay() {
  static const uint64_t day = static_cast<uint64_t>(std::time(nullptr)) / 86400;
  return setting("SEED", day);
}
