#include "cli/options/Subcommand.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <utility>

namespace tool {

namespace {

// Returns a check for a number within these bounds; it also rejects "nan".
CLI::Validator numberBetween(double low, double high) {
  const auto check = [low, high](const std::string &text) {
    char *end = nullptr;
    const double number = std::strtod(text.c_str(), &end);
    char expected[80];
    std::snprintf(expected, sizeof expected, "a number from %.10g to %.10g is expected", low, high);
    return *end == '\0' && number >= low && number <= high ? std::string() : expected;
  };
  return CLI::Validator(check, "");
}

std::string checkName(const std::string &text) {
  return text.empty() ? "is empty: the name of a file or of a port is expected" : "";
}

std::string checkFile(const std::string &name) {
  return name.empty() || name == "-" ? "the name of a file is expected; standard output is already in use" : "";
}

}  // namespace

Option &Option::required() {
  _option->required();
  return *this;
}

Option &Option::excludes(const Option &other) {
  _option->excludes(other._option);
  return *this;
}

Option &Option::between(double low, double high) {
  _option->check(numberBetween(low, high));
  return *this;
}

Option &Option::seconds() { return between(0.001, 366.0 * 24 * 60 * 60); }

Option &Option::notEmpty() {
  _option->check(CLI::Validator(checkName, ""));
  return *this;
}

Option &Option::notStandardOutput() {
  _option->check(CLI::Validator(checkFile, ""));
  return *this;
}

Option &Option::oneOf(std::initializer_list<int> values) {
  _option->check(CLI::IsMember(values).description(""));
  return *this;
}

Option &Option::type(const char *name) {
  _option->type_name(name);
  return *this;
}

bool Option::given() const { return _option != nullptr && _option->count() > 0; }

std::string Option::name() const { return _option->get_name(); }

Subcommand::Subcommand(CLI::App &app, const char *name, const char *what) : _app(app.add_subcommand(name, what)) {}

Option Subcommand::option(const char *names, std::string &value, const char *what) {
  return Option(_app->add_option(names, value, what));
}

Option Subcommand::option(const char *names, std::vector<std::string> &value, const char *what) {
  return Option(_app->add_option(names, value, what));
}

Option Subcommand::option(const char *names, double &value, const char *what) {
  return Option(_app->add_option(names, value, what));
}

Option Subcommand::option(const char *names, unsigned long &value, const char *what) {
  return Option(_app->add_option(names, value, what));
}

Option Subcommand::option(const char *names, const std::function<void(double)> &set, const char *what) {
  return Option(_app->add_option_function<double>(names, set, what));
}

Option Subcommand::flag(const char *name, const char *what) { return Option(_app->add_flag(name)->description(what)); }

Option Subcommand::flag(const char *name, bool &value, const char *what) {
  return Option(_app->add_flag(name, value, what));
}

void Subcommand::footer(const char *text) { _app->footer(text); }

void Subcommand::run(std::function<void()> work) { _app->callback(std::move(work)); }

void rejectCommandLine(const std::string &reason) {
  throw CLI::ValidationError(reason, CLI::ExitCodes::ValidationError);
}

void fail() { throw CLI::RuntimeError(EXIT_FAILURE); }

}  // namespace tool
