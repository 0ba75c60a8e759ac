// Texts in UTF-8, measured in the columns that they take on a terminal.
#pragma once

#include <string>

namespace tool {

int widthOf(const std::string &text);

// What of it fits.
std::string cut(const std::string &text, int width);

// The same, not in the middle of what it says: "Failsafe" of "Failsafe: the receiver is well, but has given the radio
// up."
std::string cutAtPhrase(const std::string &text, int width);

// Cut, or filled with blanks: on its right; on its left.
std::string padded(const std::string &text, int width);
std::string right(const std::string &text, int width);

}  // namespace tool
