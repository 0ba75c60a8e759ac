// A subcommand of `sbus` and its options. It hides CLI11: its headers cost four seconds of compile time per file.
#pragma once

#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace tool {

class Option {
 public:
  Option() = default;
  explicit Option(CLI::Option *option) : _option(option) {}

  // Each of these adds a check, and returns the option.
  Option &required();
  Option &excludes(const Option &other);
  Option &between(double low, double high);
  Option &seconds();            // up to a year
  Option &notEmpty();           // a name; it is empty if a script forgot to set a variable
  Option &notStandardOutput();  // a file name; standard output is already in use
  Option &oneOf(std::initializer_list<int> values);

  // Sets the help's placeholder for the value: "FILE"; "" for none.
  Option &type(const char *name);

  // Call these two after the command line has been read.
  bool given() const;        // false without an option
  std::string name() const;  // "--baud"

 private:
  CLI::Option *_option = nullptr;
};

class Subcommand {
 public:
  Subcommand(CLI::App &app, const char *name, const char *what);

  // Adds an option ("-o,--output" or "--output") or an argument ("FILE"). `value` must outlive the subcommand.
  Option option(const char *names, std::string &value, const char *what);
  Option option(const char *names, std::vector<std::string> &value, const char *what);
  Option option(const char *names, double &value, const char *what);
  Option option(const char *names, unsigned long &value, const char *what);
  Option option(const char *names, const std::function<void(double)> &set, const char *what);
  Option flag(const char *name, const char *what);
  Option flag(const char *name, bool &value, const char *what);

  // Sets the last paragraph of the help.
  void footer(const char *text);

  // Sets the function that does the subcommand's work.
  void run(std::function<void()> work);

 private:
  CLI::App *_app;
};

// Prints `reason` and where to find help to standard error, and ends the program with status 2.
[[noreturn]] void rejectCommandLine(const std::string &reason);

// Ends the program with status 1. The subcommand has already said why.
[[noreturn]] void fail();

}  // namespace tool
