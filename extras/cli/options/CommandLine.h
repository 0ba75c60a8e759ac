// The command line itself: help, suggestions for misspelt names, completion.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace tool {

// Adds `sbus help SUBCOMMAND`.
void addHelp(CLI::App &app);

// Returns what is wrong with the first word that `app` could not place, with a suggestion; empty if it could place all
// words.
std::string misplacedWord(const CLI::App &app);

// Returns "NAME is not a subcommand ..." with a suggestion.
std::string unknownSubcommand(const CLI::App &app, const std::string &name);

// Returns the subcommand that is meant if the first word is a source: monitor for a port or sim, summary for a file;
// otherwise "".
std::string subcommandFor(const CLI::App &app, const std::string &word);

// Prints the completions of the last of `words`, the words after `sbus`, one per line; ":files" stands for file names.
void printCompletions(const CLI::App &app, const std::vector<std::string> &words);

// Reads sbus.1.in from standard input, and prints sbus.1. A line ".SUBCOMMAND NAME" becomes the section of a
// subcommand, with its options at the section's end; ".OPTION NAME --a --b" describes these here.
void printManual(const CLI::App &app);

// Breaks the lines of help at the terminal's width. Call it before subcommands are added.
void formatHelp(CLI::App &app);

// Returns the program's version and those of its libraries.
std::string versionText();

}  // namespace tool
