/// @file
/// The names of the rules by which frames are found, so that each can be left out to see what it is worth.
#pragma once

#include <stdint.h>

namespace sbus {

/// extras/docs/receiver.md explains each. `make impairment WITHOUT=rule` compiles the library with SBUS_WITHOUT=rule.
enum class Rule : uint8_t {
  none,
  flags,
  inside,
  variant,
  tail,
  extraHeader,
  slots,
  turn,
  stray,
  endsTwice,
  goesOn,
  other,
  first,
  falseSync,
  waits,
  silence,
};

/// The rule that is left out. Default: none.
#if !defined(SBUS_WITHOUT)
#define SBUS_WITHOUT none
#endif

/// Returns true for every rule but the one that is left out.
constexpr bool holds(Rule rule) {
  return rule != Rule::SBUS_WITHOUT;
}

}  // namespace sbus
