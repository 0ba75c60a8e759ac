// main() of every unit program on the Cortex-M0.
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>

static_assert(sizeof(int) == 4 && sizeof(long) == 4 && sizeof(void *) == 4, "the sizes of the board's processor");
