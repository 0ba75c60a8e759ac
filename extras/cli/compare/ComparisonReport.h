// Formats a comparison for `sbus compare`.
#pragma once

#include <array>
#include <string>

#include "line/compare/Comparison.h"

namespace tool {

std::string json(const line::LostSpan &span);

// `names`: the sources'. `aligner`: found the pairs.
std::string text(const line::Comparison &comparison, const std::array<std::string, 2> &names,
                 const line::Aligner &aligner);
std::string json(const line::Comparison &comparison, const line::Aligner &aligner);

}  // namespace tool
