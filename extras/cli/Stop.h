// Ends a subcommand after Ctrl-C and similar signals so that its output is complete.
#pragma once

namespace tool {

constexpr int WrongCommandLine = 2;  // exit status

// Makes SIGINT, SIGTERM and SIGHUP (Windows: SIGBREAK) set stopped(); a second signal ends the program at once.
void catchSignals();

// Returns true after such a signal.
bool stopped();

// Makes stopped() return false again: the signal ended a pipe, but its content is still to be read.
void forgetStop();

}  // namespace tool
