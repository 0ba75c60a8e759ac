// Shows on a terminal how much of a long work is done: after two seconds in which nothing was printed.
#pragma once

#include <string>

namespace tool {

// Watches the files that are read. Call it once, before the first one.
void watchProgress();

// Returns true if showProgress() is due, at most five times a second; call it often.
bool isProgressDue();

// Replaces the line that is shown, on standard error. Nothing happens while a file tells how much of it is read.
void showProgress(const std::string &text);

// Removes it, and waits for two seconds again. Call it before something is printed.
void hideProgress();

}  // namespace tool
