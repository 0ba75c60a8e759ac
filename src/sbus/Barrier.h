/// @file
/// Compiler barrier.
#pragma once

namespace sbus {

/// Keeps the compiler from moving reads and writes past it: an interrupt may come there. (clang moves reads past
/// __atomic_signal_fence(); -Os would call a function that is only inline.)
__attribute__((always_inline)) inline void barrier() { __asm__ volatile("" ::: "memory"); }

}  // namespace sbus
