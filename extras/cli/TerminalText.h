// Texts in UTF-8, measured in the columns that they take on a terminal.
#pragma once

#include <string>

namespace tool {

int widthOf(const std::string &text);

// Returns as much of the text as fits.
std::string cut(const std::string &text, int width);

// Cuts after a title or a sentence: "Failsafe" of "Failsafe: the receiver works, but has lost the link."
std::string cutAtPhrase(const std::string &text, int width);

// Return the text with exactly `width` columns: cut, or filled with blanks on its right, or on its left.
std::string padded(const std::string &text, int width);
std::string right(const std::string &text, int width);

}  // namespace tool
