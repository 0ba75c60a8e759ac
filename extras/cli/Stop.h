// Ctrl-C and the like: a subcommand ends by itself, and what it has written is whole.
#pragma once

namespace tool {

constexpr int WrongCommandLine = 2;  // exit status

// Makes SIGINT, SIGTERM and SIGHUP ask for the end; a second signal ends the program at once. A closed pipe becomes an
// error of write().
void catchSignals();

// Returns true once the end was asked for.
bool stopped();

}  // namespace tool
