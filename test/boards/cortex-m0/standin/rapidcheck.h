// The little of RapidCheck that the unit programs use, for a machine that RapidCheck was not built for: the same
// properties, tried on random values, but no shrinking of what fails. The numbers are the same in every run.
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <vector>

#include "support/Random.h"

namespace rc {

constexpr unsigned Tries = 100;    // as many as RapidCheck makes
constexpr uint32_t Longest = 100;  // elements of a container, as RapidCheck's size

inline Random &numbers() {
  static Random random(20181);  // run.sh's seed
  return random;
}

struct Refuted {
  const char *what;
};

template <typename T>
struct Gen {
  std::function<T()> make;
  T operator*() const { return make(); }
};

namespace gen {

template <typename T>
struct Arbitrary {
  static T make() { return static_cast<T>(numbers().next()); }
};
template <>
struct Arbitrary<bool> {
  static bool make() { return numbers().below(2) != 0; }
};
template <typename T, size_t Size>
struct Arbitrary<std::array<T, Size>> {
  static std::array<T, Size> make() {
    std::array<T, Size> values;
    for (T &value : values) {
      value = Arbitrary<T>::make();
    }
    return values;
  }
};

template <typename T>
Gen<T> arbitrary() {
  return {Arbitrary<T>::make};
}

template <typename T>
Gen<T> inRange(T from, T to) {
  return {
      [from, to] { return static_cast<T>(from + static_cast<T>(numbers().below(static_cast<uint32_t>(to - from)))); }};
}

template <typename T, typename... More>
Gen<T> element(T first, More... more) {
  const std::vector<T> values = {first, static_cast<T>(more)...};
  return {[values] { return values[numbers().below(static_cast<uint32_t>(values.size()))]; }};
}

template <typename T, typename... More>
Gen<T> oneOf(Gen<T> first, More... more) {
  const std::vector<Gen<T>> choices = {first, more...};
  return {[choices] { return *choices[numbers().below(static_cast<uint32_t>(choices.size()))]; }};
}

template <typename Container>
Gen<Container> container(Gen<typename Container::value_type> value) {
  return {[value] {
    Container values(numbers().below(Longest + 1));
    for (auto &each : values) {
      each = *value;
    }
    return values;
  }};
}

}  // namespace gen

template <typename Property>
bool check(const char *name, const Property &property) {
  try {
    for (unsigned i = 0; i < Tries; i++) {
      property();
    }
  } catch (const Refuted &refuted) {
    std::printf("%s: not so: %s\n", name, refuted.what);
    return false;
  }
  return true;
}

}  // namespace rc

#define RC_ASSERT(condition)         \
  do {                               \
    if (!(condition)) {              \
      throw rc::Refuted{#condition}; \
    }                                \
  } while (false)
