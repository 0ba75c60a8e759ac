#include "cli/options/CommandLine.h"

#include <archive.h>
#include <curses.h>
#include <libserialport.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>
#include <sstream>

#include "cli/Output.h"
#include "cli/subcommands/Subcommands.h"
#include "line/system/System.h"

namespace tool {

namespace {

using Words = std::vector<std::string>;

constexpr const char *Files = ":files";

Words subcommandNames(const CLI::App &app) {
  Words names;
  for (const CLI::App *const each : app.get_subcommands([](const CLI::App *) { return true; })) {
    names.push_back(each->get_name());
  }
  return names;
}

Words optionNames(const CLI::App &app) {
  Words names;
  for (const CLI::Option *const option : app.get_options()) {
    for (const std::string &name : option->get_lnames()) {
      names.push_back("--" + name);
    }
  }
  return names;
}

// Returns the edit distance: letters to insert, delete, replace, or swap with the next one.
size_t distance(const std::string &a, const std::string &b) {
  std::vector<std::vector<size_t>> least(a.size() + 1, std::vector<size_t>(b.size() + 1));
  for (size_t i = 0; i <= a.size(); i++) {
    for (size_t j = 0; j <= b.size(); j++) {
      size_t &here = least[i][j];
      here = i + j;
      if (i > 0 && j > 0) {
        here = std::min({least[i - 1][j] + 1, least[i][j - 1] + 1, least[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
      }
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        here = std::min(here, least[i - 2][j - 2] + 1);
      }
    }
  }
  return least[a.size()][b.size()];
}

// Returns "did you mean NAME? " for the nearest name: one that begins with `word`, or in which at most a third of the
// letters are wrong. Returns "" if there is no such name.
std::string suggestion(const std::string &word, const Words &names) {
  std::string nearest;
  size_t least = SIZE_MAX;
  for (const std::string &name : names) {
    const bool begun = word.size() >= 3 && name.rfind(word, 0) == 0;
    const size_t wrong = begun ? 0 : distance(word, name);
    if (wrong < least && wrong * 3 <= word.size()) {
      nearest = name;
      least = wrong;
    }
  }
  return nearest.empty() ? "" : "did you mean " + nearest + "? ";
}

// What earlier versions had, and where to go.
struct Withdrawn {
  const char *word;
  const char *now;
};
constexpr Withdrawn AllWithdrawn[] = {
    {"joystick", "the recipe \"Simulators and games\" of extras/docs/recipes.md is a program of 20 lines"},
    {"calibrate", "the example Calibrate measures the sticks on the board"},
    {"explain", "sbus hex --values prints bytes and values, and the scope explains each byte"},
    {"plot", "sbus summary -o report.html has the curves"},
    {"replay", "sbus send plays a recording"},
    {"simulate", "sbus send sim plays the simulated receiver"},
    {"--html", "write sbus summary -o report.html"},
    {"--loop", "write while sbus send FILE; do :; done"},
    {"--mix", "write sbus bridge SOURCE - | jq ... | sbus send -: README.md of extras/cli has an example"}};

// Returns "was withdrawn; ..." for such a word, otherwise "".
std::string whereTo(const std::string &word) {
  const auto found = std::find_if(std::begin(AllWithdrawn), std::end(AllWithdrawn),
                                  [&](const Withdrawn &each) { return word == each.word; });
  return found == std::end(AllWithdrawn) ? "" : std::string(" was withdrawn; ") + found->now;
}

const CLI::App *find(const CLI::App &app, const std::string &name) {
  const auto all = app.get_subcommands([&name](const CLI::App *each) { return each->get_name() == name; });
  return all.empty() ? nullptr : all.front();
}

void printHelp(const CLI::App &app, const std::string &name) {
  const CLI::App *const subcommand = name.empty() ? &app : find(app, name);
  if (subcommand == nullptr) {
    throw CLI::ValidationError(unknownSubcommand(app, name));
  }
  const std::string prefix = name.empty() ? "" : app.get_name() + " ";
  write(app.get_formatter()->make_help(subcommand, prefix + subcommand->get_name(), CLI::AppFormatMode::Normal));
  flush();
}

// Breaks the lines of a help text that are longer than this. CLI11 puts what an option does in column 30.
std::string wrapped(const std::string &text, size_t columns) {
  constexpr size_t Column = 30, Narrow = 60;
  std::istringstream lines(text);
  std::string all;
  for (std::string line; std::getline(lines, line);) {
    const size_t indent = line.substr(0, 1) != " " ? 0 : columns < Narrow ? 4 : Column;
    for (size_t most = columns; line.size() > most;) {
      const size_t blank = line.rfind(' ', most);
      if (blank == std::string::npos || blank <= indent) {
        break;
      }
      all += line.substr(0, blank) + '\n';
      line = std::string(indent, ' ') + line.substr(blank + 1);
    }
    all += line + '\n';
  }
  return all;
}

// In a pipe or a file lines are not broken.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App *app, std::string name, CLI::AppFormatMode mode) const override {
    const std::string text = CLI::Formatter::make_help(app, name, mode);
    const size_t columns = line::terminalColumns();
    return columns > 0 ? wrapped(text, columns) : text;
  }
};

bool takesValue(const CLI::Option &option) { return option.get_items_expected_min() > 0; }

// Returns the possible words for an argument of this `type`: for "auto|always|never" these three, for a name in
// capitals the words that it stands for.
Words wordsFor(const CLI::App &app, const std::string &type) {
  Words words;
  std::istringstream parts(type);
  for (std::string part; std::getline(parts, part, '|');) {
    const bool isSource = part == "SOURCE" || part == "A" || part == "B";
    const bool port = isSource || part == "DEVICE";
    const Words ports = port ? portNames() : part == "SUBCOMMAND" ? subcommandNames(app) : Words();
    words.insert(words.end(), ports.begin(), ports.end());
    if (isSource) {
      words.push_back("sim");
    } else if (part == "LIST") {
      words.insert(words.end(), {"ch1-ch4,failsafe,lostframe", "ch1-ch18", "ch1-ch24", "ch1-ch32", "time,state,age"});
    }
    if (port || part.rfind("FILE", 0) == 0 || part == "CAPTURE" || part == "RECORDING") {
      words.push_back(Files);
    } else if (std::none_of(part.begin(), part.end(), [](unsigned char letter) { return std::isupper(letter); })) {
      words.push_back(part);
    }
  }
  return words;
}

// Returns the words that may follow `before`, which begins with the subcommand.
Words wordsAfter(const CLI::App &app, const Words &before) {
  const CLI::App *const subcommand = find(app, before[0]);
  if (subcommand == nullptr) {
    return {};
  }
  size_t placed = 0;
  for (size_t i = 1; i < before.size(); i++) {
    const CLI::Option *const option =
        before[i].rfind('-', 0) == 0 && before[i] != "-" ? subcommand->get_option_no_throw(before[i]) : nullptr;
    if (option != nullptr && takesValue(*option) && ++i == before.size()) {
      return wordsFor(app, option->get_type_name());
    }
    placed += option == nullptr;
  }
  Words words = optionNames(*subcommand);
  const auto isArgument = [](const CLI::Option *option) { return option->get_positional(); };
  for (const CLI::Option *const option : subcommand->get_options(isArgument)) {
    if (placed-- == 0) {
      const Words own = wordsFor(app, option->get_name());
      words.insert(words.end(), own.begin(), own.end());
    }
  }
  return words;
}

}  // namespace

void addHelp(CLI::App &app) {
  CLI::App *const subcommand = app.add_subcommand("help", "prints the options of a subcommand");
  const auto name = std::make_shared<std::string>();
  subcommand->add_option("SUBCOMMAND", *name, "the subcommand; without it, all are listed")->type_name("");
  subcommand->callback([&app, name] { printHelp(app, *name); });
}

void formatHelp(CLI::App &app) { app.formatter(std::make_shared<HelpFormatter>()); }

std::string versionText() {
  return "sbus " VERSION " (DecodeSBus)\nCLI11 " CLI11_VERSION ", libserialport " +
         std::string(sp_get_package_version_string()) + ", " + archive_version_string() + ", ncurses " +
         NCURSES_VERSION;
}

std::string misplacedWord(const CLI::App &app) {
  const Words own = app.remaining();
  const auto subcommands = app.get_subcommands();
  const std::string name = subcommands.empty() || !own.empty() ? "sbus" : "sbus " + subcommands.front()->get_name();
  const Words left = own.empty() && !subcommands.empty() ? subcommands.front()->remaining() : own;
  if (left.empty()) {
    return {};
  }
  const auto option =
      std::find_if(left.begin(), left.end(), [](const std::string &word) { return word[0] == '-' && word != "-"; });
  const std::string help = name == "sbus" ? "sbus --help" : "sbus help " + name.substr(5);
  if (option == left.end()) {
    return name + ": " + left.front() + " is an unexpected argument; " + help + " lists what it takes";
  }
  if (!subcommands.empty() && !own.empty() && subcommands.front()->get_option_no_throw(*option) != nullptr) {
    const std::string &owner = subcommands.front()->get_name();
    return "sbus: " + *option + " is an option of " + owner + "; write it after " + owner;
  }
  const std::string optionName = option->substr(0, option->find('='));
  if (!whereTo(optionName).empty()) {
    return name + ": " + optionName + whereTo(optionName);
  }
  return name + ": " + *option + " is not an option; " +
         suggestion(*option, optionNames(subcommands.empty() || !own.empty() ? app : *subcommands.front())) + help +
         " lists them";
}

std::string unknownSubcommand(const CLI::App &app, const std::string &name) {
  const std::string instead = whereTo(name);
  return !instead.empty() ? name + instead
                          : name + " is not a subcommand" +
                                (name.find_first_of("./") == std::string::npos ? "" : ", and there is no such file") +
                                "; " + suggestion(name, subcommandNames(app)) + "sbus --help lists them";
}

std::string subcommandFor(const CLI::App &app, const std::string &word) {
  const bool isSimulated = word == "sim" || word.rfind("sim:", 0) == 0;
  std::error_code error;
  const auto type = std::filesystem::status(word, error).type();
  const bool isFile = type == std::filesystem::file_type::regular;
  const bool isPort = line::isPortName(word) || (!isFile && type != std::filesystem::file_type::directory && !error);
  return word.empty() || word[0] == '-' || find(app, word) != nullptr ? ""
         : isFile                                                     ? "summary"
         : isSimulated || isPort                                      ? "monitor"
                                                                      : "";
}

void printCompletions(const CLI::App &app, const Words &words) {
  Words before;
  std::copy_if(words.begin(), words.end(), std::back_inserter(before),
               [](const std::string &word) { return word != "="; });  // bash splits --output=FILE
  const std::string begun = before.empty() ? "" : before.back();
  if (!before.empty()) {
    before.pop_back();
  }
  Words found = before.empty() ? subcommandNames(app) : wordsAfter(app, before);
  if (before.empty()) {
    const Words options = optionNames(app);
    found.insert(found.end(), options.begin(), options.end());
  }
  for (const std::string &each : found) {
    const bool option = !begun.empty() && begun[0] == '-';
    if (each == Files ? !option : each.rfind(begun, 0) == 0 && (each[0] != '-' || option)) {
      write(each + '\n');
    }
  }
  flush();
}

}  // namespace tool
