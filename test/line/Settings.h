// Settings from the environment: FRAMES=1000000 SEED=7 make torture
#pragma once

#include <cstdint>
#include <cstdlib>

inline uint64_t setting(const char *name, uint64_t otherwise) {
  const char *const text = std::getenv(name);
  return text != nullptr && *text != 0 ? std::strtoull(text, nullptr, 10) : otherwise;
}

inline uint64_t framesPerCase(uint64_t otherwise) {
  return setting("FRAMES", otherwise);
}

inline uint64_t seedOfAll() {
  return setting("SEED", 20181);
}
