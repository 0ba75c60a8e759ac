// sbus: looks at S.Bus lines, records, replays and diagnoses them.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iostream>

#include "cli/Stop.h"
#include "cli/options/CommandLine.h"
#include "cli/subcommands/Subcommands.h"
#include "line/system/System.h"

namespace {

void addSubcommands(CLI::App &app) {
  tool::addPorts(app);
  tool::addMonitor(app);
  tool::addDoctor(app);
  tool::addSummary(app);
  tool::addCompare(app);
  tool::addTelemetry(app);
  tool::addHex(app);
  tool::addCsv(app);
  tool::addRecord(app);
  tool::addWatch(app);
  tool::addSend(app);
  tool::addBridge(app);
  tool::addDecode(app);
  tool::addWave(app);
  tool::addHelp(app);
}

// Returns "sbus" and the subcommand in use.
std::string nameOf(const CLI::App &app) {
  const auto subcommands = app.get_subcommands();
  return subcommands.empty() ? app.get_name() : app.get_name() + " " + subcommands.front()->get_name();
}

}  // namespace

int main(int argc, char **argv) {
  line::prepareStreams();
  CLI::App app{"Monitors, records, sends and diagnoses S.Bus lines.", "sbus"};
  app.require_subcommand(1);
  app.allow_windows_style_options(false);  // /tmp/flight.txt is a file, on Windows also
  tool::formatHelp(app);
  app.set_version_flag("--version", tool::versionText(), "print the version, and those of the libraries");
  app.set_help_flag("-h,--help", "list the subcommands, as sbus alone does; after a subcommand, its options");
  app.set_help_all_flag("--help-all", "print the options of every subcommand");
  app.footer(
      "SOURCE is a serial port (see `sbus ports`), a file (a recording, a logic analyser's capture, bytes), - for "
      "standard input, or sim, a built-in receiver. Without a subcommand a port is shown (monitor), and a file "
      "summarised "
      "(summary). `sbus help SUBCOMMAND` and `man sbus` tell more.");
  addSubcommands(app);
  tool::catchSignals();
  try {
    if (argc > 1 && std::strcmp(argv[1], "__complete") == 0) {  // of completion.bash, completion.zsh, completion.fish
      tool::printCompletions(app, {argv + 2, argv + argc});
      return EXIT_SUCCESS;
    }
    if (argc > 1 && std::strcmp(argv[1], "__manual") == 0) {  // of the Makefile
      tool::printManual(app);
      return EXIT_SUCCESS;
    }
    std::vector<std::string> words(argv + 1, argv + argc);
    if (const std::string meant = argc > 1 ? tool::subcommandFor(app, words[0]) : ""; !meant.empty()) {
      std::fprintf(stderr, "sbus: this is sbus %s %s\n", meant.c_str(), words[0].c_str());
      words.insert(words.begin(), meant);
    }
    std::reverse(words.begin(), words.end());  // as CLI11 takes them
    app.parse(words);
  } catch (const CLI::RuntimeError &error) {
    return error.get_exit_code();  // the subcommand has said why
  } catch (const CLI::ParseError &error) {
    if (argc == 1) {
      std::fputs(app.help().c_str(), stderr);
      return tool::WrongCommandLine;
    }
    if (argc > 1 && argv[1][0] != '-' && app.get_subcommands().empty()) {
      std::fprintf(stderr, "%s\n", tool::unknownSubcommand(app, argv[1]).c_str());
      return tool::WrongCommandLine;
    }
    if (error.get_exit_code() != 0 && !tool::misplacedWord(app).empty()) {
      std::fprintf(stderr, "%s\n", tool::misplacedWord(app).c_str());
      return tool::WrongCommandLine;
    }
    const int status = app.exit(error, std::cout, std::cerr);
    return status != 0 ? tool::WrongCommandLine : std::cout.flush() ? EXIT_SUCCESS : EXIT_FAILURE;
  } catch (const std::exception &error) {
    std::fprintf(stderr, "%s: %s\n", nameOf(app).c_str(), error.what());
    return EXIT_FAILURE;
  }
}
