// Formats a comparison for `sbus compare`.
#pragma once

#include <array>
#include <string>

#include "line/compare/Comparison.h"

namespace tool {

std::string json(const line::LostSpan &span);

// `names`: the sources'. `isByContents`: see Aligner.
std::string text(const line::Comparison &comparison, const std::array<std::string, 2> &names, bool isByContents);
std::string json(const line::Comparison &comparison, bool isByContents);

}  // namespace tool
