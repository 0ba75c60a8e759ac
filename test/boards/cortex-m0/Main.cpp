// main() of every unit program on the Cortex-M0, and what doctest/doctest.h declares.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

static_assert(sizeof(int) == 4 && sizeof(long) == 4 && sizeof(void *) == 4, "the sizes of the board's processor");

namespace {

unsigned long cases = 0;
unsigned long assertions = 0;
unsigned long failures = 0;
const char *running = "";
const doctest::Context *innermost = nullptr;
doctest::TestCase *first = nullptr;
doctest::TestCase **last = &first;

int finish() {
  std::printf("test cases: %lu\nassertions: %lu\nfailed: %lu\n", cases, assertions, failures);
  return failures == 0 && cases > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

namespace doctest {

bool operator==(double value, const Approx &expected) {
  constexpr double Epsilon = static_cast<double>(std::numeric_limits<float>::epsilon()) * 100;
  return std::fabs(value - expected.value) < Epsilon * (1 + std::max(std::fabs(value), std::fabs(expected.value)));
}

Context::Context() : _outer(innermost) { innermost = this; }

Context::~Context() { innermost = _outer; }

TestCase::TestCase(const char *name, void (*run)()) : _name(name), _run(run) {
  *last = this;
  last = &_next;
}

int TestCase::runAll() {
  for (const TestCase *each = first; each != nullptr; each = each->_next) {
    cases++;
    running = each->_name;
    each->_run();
  }
  return finish();
}

bool check(bool good, const char *file, int line, const char *text) {
  assertions++;
  if (!good) {
    failures++;
    std::printf("%s\n%s:%d: FAILED: %s\n", running, file, line, text);
    for (const Context *context = innermost; context != nullptr; context = context->outer()) {
      std::printf("  %s\n", context->text().c_str());
    }
  }
  return good;
}

void giveUp() { std::exit(finish()); }

}  // namespace doctest

int main() { return doctest::TestCase::runAll(); }
