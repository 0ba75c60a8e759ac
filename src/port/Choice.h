/// @file
/// Chooses the first of several overloads that compiles.
#pragma once

namespace sbus {

/// @cond  Not for sketches.

// Orders overloads: of those that compile, the one with the highest number is called.
template <int Number>
struct Choice : Choice<Number - 1> {};
// The last choice.
template <>
struct Choice<0> {};

/// @endcond

}  // namespace sbus
