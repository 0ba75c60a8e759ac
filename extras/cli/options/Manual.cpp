#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <iostream>
#include <set>
#include <sstream>

#include "cli/Output.h"
#include "cli/options/CommandLine.h"

namespace tool {

namespace {

std::string escaped(const std::string &text) {
  std::string all;
  for (const char c : text) {
    all += c == '-' ? "\\-" : c == '\'' ? "\\(aq" : std::string(1, c);
  }
  return all;
}

// Returns a text of the help as sentences.
std::string sentence(std::string text) {
  if (!text.empty()) {
    text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
    text += text.back() == '.' ? "\n" : ".\n";
  }
  return escaped(text);
}

std::string describe(const CLI::Option &option) {
  const std::vector<std::string> &letters = option.get_snames();
  return ".TP\n" + (letters.empty() ? "" : "\\fB\\-" + letters.front() + "\\fR, ") + "\\fB\\-\\-" +
         escaped(option.get_lnames().front()) + "\\fR " + escaped(option.get_type_name()) + '\n' +
         sentence(option.get_description());
}

// Returns the beginning of a subcommand's section. A footer may be inherited.
std::string title(const CLI::App &app, const CLI::App &subcommand) {
  std::string words;
  for (const CLI::Option *const each : subcommand.get_options()) {
    const std::string name = each->get_name();
    words += each->get_positional() ? (each->get_required() ? ' ' + name : " [" + name + ']') : "";
  }
  return ".SS sbus " + subcommand.get_name() + words + '\n' + sentence(subcommand.get_description()) +
         (subcommand.get_footer() == app.get_footer() ? "" : sentence(subcommand.get_footer()));
}

}  // namespace

void printManual(const CLI::App &app) {
  const CLI::App *section = nullptr;
  std::set<std::string> described = {describe(*app.get_help_ptr()), describe(*app.get_help_all_ptr())};
  const auto describeOnce = [&](const CLI::Option *option) {
    if (!option->get_positional() && described.insert(describe(*option)).second) {
      write(describe(*option));
    }
  };
  for (std::string line; std::getline(std::cin, line);) {
    std::istringstream words(line);
    std::string macro, word;
    words >> macro >> word;
    const bool begins = macro == ".SUBCOMMAND";
    if (begins || macro == ".SH") {
      if (section != nullptr) {
        const auto options = section->get_options();
        std::for_each(options.begin(), options.end(), describeOnce);
      }
      section = begins ? app.get_subcommand(word) : nullptr;
    }
    if (line == ".SH OPTIONS") {
      described.clear();
      section = &app;
    }
    if (macro == ".OPTION") {
      for (std::string name; words >> name;) {
        describeOnce(app.get_subcommand(word)->get_option(name));
      }
    } else {
      write(begins ? title(app, *section) : line + '\n');
    }
  }
  flush();
}

}  // namespace tool
