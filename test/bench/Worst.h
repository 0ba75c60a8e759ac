// What bad lines cost: in the long run, and in the worst single call of parseSBusFrame().
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "Lines.h"

constexpr size_t LongestLead = 64;
constexpr size_t LongestCall = 64;

// A receiver that has seen some frames or none, then some bytes, takes in the bytes of one call.
struct Attack {
  bool locked;                                           // three neutral frames came before
  uint8_t lead;                                          // bytes that come after these,
  uint8_t burst;                                         // so many in each call
  uint16_t gapUs;                                        // between the calls
  std::array<uint8_t, LongestLead + LongestCall> bytes;  // the last `lead` of LongestLead, then those of the call
};

enum class Way { Ours, Papers };

// Sets `size` to the number of bytes in the call.
Attack attackOf(const WorstCall &known, size_t &size);

// Instructions of the call that takes the first `count` bytes after the lead.
uint32_t costOf(const Attack &attack, size_t count, Way way);

// Of the line's first `count` bytes, 16 in a call and without a pause.
uint32_t streamCost(const BadLine &line, size_t count, Way way);

// The worst call of a line: begun at any byte of its pattern, after leads of any length.
uint32_t worstOf(const BadLine &line, size_t count, Way way);

// Looks for the worst call of ours: climbs from random bytes, `tries` times a change that is kept if it costs no less.
// The same seed gives the same.
Attack search(size_t count, uint32_t tries, uint64_t seed);

// The bytes as hex digits, the call's after a bar.
void print(const Attack &attack, size_t count);
