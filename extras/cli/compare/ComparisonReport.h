// Formats a comparison for `sbus compare`.
#pragma once

#include <array>
#include <string>

#include "line/compare/Comparison.h"

namespace tool {

// `zeroUs`: A's own time at the comparison's time 0.
std::string json(const line::LostSpan &span, int64_t zeroUs);

// `names`: the sources'. `aligner`: found the pairs.
std::string text(const line::Comparison &comparison, const std::array<std::string, 2> &names, int64_t zeroUs,
                 const line::Aligner &aligner);
std::string json(const line::Comparison &comparison, int64_t zeroUs, const line::Aligner &aligner);

}  // namespace tool
