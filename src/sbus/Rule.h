/// @file
/// The receiver's rules by name, so that each can be taken out to see what it is worth.
#pragma once

#include <stdint.h>

namespace sbus {

/// extras/docs/receiver.md says what each is. `make impairment WITHOUT=rule` compiles the library with SBUS_WITHOUT=name.
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
  halves,
  waits,
  silence,
};

/// The rule that is left out: none.
#if !defined(SBUS_WITHOUT)
#define SBUS_WITHOUT none
#endif

/// True for every rule but the one that was taken out.
constexpr bool holds(Rule rule) {
  return rule != Rule::SBUS_WITHOUT;
}

}  // namespace sbus
