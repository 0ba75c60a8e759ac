// A subcommand of `sbus` and its options. It hides CLI11, whose headers take four seconds to compile in each file.
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

  // Each of these checks the command line, and returns the option.
  Option &required();
  Option &excludes(const Option &other);
  Option &between(double low, double high);
  Option &seconds();            // up to a year
  Option &once();               // of several values: each has the option's name before it
  Option &notEmpty();           // a name: an empty one is a variable that a script has forgotten to set
  Option &notStandardOutput();  // the name of a file: standard output is already in use
  Option &oneOf(std::initializer_list<int> values);
  Option &oneOf(std::initializer_list<const char *> values);

  // Sets what the help shows for the value: "FILE"; "" for nothing.
  Option &type(const char *name);

  // Both are known once the command line is read.
  bool given() const;
  std::string name() const;  // "--baud"

 private:
  CLI::Option *_option = nullptr;
};

class Subcommand {
 public:
  Subcommand(CLI::App &app, const char *name, const char *what);

  // Adds an option, "-o,--output" or "--output", or an argument, "FILE". `value` must outlive the subcommand.
  Option option(const char *names, std::string &value, const char *what);
  Option option(const char *names, std::vector<std::string> &value, const char *what);
  Option option(const char *names, double &value, const char *what);
  Option option(const char *names, int &value, const char *what);
  Option option(const char *names, unsigned &value, const char *what);
  Option option(const char *names, unsigned long &value, const char *what);
  Option option(const char *names, const std::function<void(double)> &set, const char *what);
  Option flag(const char *name, const char *what);
  Option flag(const char *name, bool &value, const char *what);

  // Sets what the help says at its end.
  void footer(const char *text);

  // Sets what does the subcommand's work.
  void run(std::function<void()> work);

 private:
  CLI::App *_app;
};

// Ends the program with status 2, and with `reason` and where the help is on standard error.
[[noreturn]] void rejectCommandLine(const std::string &reason);

// Ends the program with status 1. The subcommand has said why.
[[noreturn]] void fail();

}  // namespace tool
