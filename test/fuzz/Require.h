// Ends a fuzz program that finds a fault.
#pragma once

#include <cstdio>
#include <cstdlib>

inline void require(bool condition, const char *what) {
  if (!condition) {
    std::fprintf(stderr, "violated: %s\n", what);
    std::abort();
  }
}
