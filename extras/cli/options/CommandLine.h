// The command line itself: help, the names that were probably meant, completion.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace tool {

// Adds `sbus help SUBCOMMAND`.
void addHelp(CLI::App &app);

// Returns what is wrong with the first word that `app` could not place, with the name that was probably meant; empty if
// it could place all words.
std::string misplacedWord(const CLI::App &app);

// Returns "NAME is not a subcommand ..." with the name that was probably meant.
std::string unknownSubcommand(const CLI::App &app, const std::string &name);

// Prints what the last of `words`, those after `sbus`, may become, one a line; ":files" for the names of files.
void printCompletions(const CLI::App &app, const std::vector<std::string> &words);

}  // namespace tool
