// Recognises texts of other programs that hold the wire or its bytes in a form that is not read.
#pragma once

#include <string>
#include <string_view>

namespace line {

// Returns what a text is, and which command exports its bytes; nothing for any other text.
std::string whatText(std::string_view begin);

}  // namespace line
