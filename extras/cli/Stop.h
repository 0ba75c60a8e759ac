// Ctrl-C and the like: a subcommand ends by itself, and what it has written is whole.
#pragma once

namespace tool {

constexpr int WrongCommandLine = 2;  // exit status

// SIGINT, SIGTERM and SIGHUP ask for the end, a second one does not wait for it. A closed pipe is an error of write().
void catchSignals();

// True once the end was asked for.
bool stopped();

}  // namespace tool
