// UTF-8 texts, measured in terminal columns.
#pragma once

#include <string>

namespace tool {

int widthOf(const std::string &text);

// Returns as much of the text as fits.
std::string cut(const std::string &text, int width);

// Cuts after a title or a sentence: "Failsafe: the receiver works, but has lost the link." becomes "Failsafe".
std::string cutAtPhrase(const std::string &text, int width);

// Return the text cut or padded to exactly `width` columns. padded() adds blanks on the right, right() on the left.
std::string padded(const std::string &text, int width);
std::string right(const std::string &text, int width);

}  // namespace tool
